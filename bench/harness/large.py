"""The large program: a hundred sequences of ten steps, a hundred of its thousand steps active.

Every sequence goes round, and each of its transitions waits for one of 31 inputs; with all of them True a hundred
transitions fire in every scan. One of the ten steps of each has an action. Sleeping steps, with a transition and an action each, stand in sequences of a hundred
steps of which none is ever active.
"""

from dataclasses import dataclass

INPUTS = 31
ACTS = 6
SEQUENCES, STEPS, SLEEPERS = 100, 10, 100


@dataclass(frozen=True)
class Sequence:
    """Goes round: from each step to the next, from the last to the first."""

    name: str
    length: int
    shift: int
    awake: bool

    def steps(self):
        """The numbers of its steps, the first of which is initial when it is awake."""
        return range(1, self.length + 1)

    def behind(self, step):
        """The step behind a step."""
        return step % self.length + 1

    def trigger(self, step):
        """The number of the input that leads on from a step."""
        return (7 * self.shift + step) % INPUTS

    def output(self, step):
        """The number of the output that a step switches on, or none."""
        if not self.awake:
            return 1 + (self.shift + step) % (INPUTS - 1)
        return self.shift % INPUTS if step == ACTS else None


def sequences(sleeping):
    """All of them, with so many sleeping steps."""
    awake = [Sequence(f"G{number}", STEPS, number, True) for number in range(SEQUENCES)]
    asleep = [Sequence(f"Sleeping{number}", SLEEPERS, number, False) for number in range(sleeping // SLEEPERS)]
    return awake + asleep
