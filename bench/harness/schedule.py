"""Schedules: what an image is given to scan, and what it has to answer.

One command a line; `#` begins a comment.

    in A B C         names of the inputs, from bit 0 of `bench_in`
    out Q R          names of the outputs, from bit 0 of `bench_out`
    init             scan 0
    set A=1 B=0      writes inputs
    all 1            writes every input
    scan N LABEL     N scans
    rest N           four scans, in which what was set before takes effect and settles, then N labelled `idle`
    look N           N scans labelled `steady` by `look_once`, which looks at the whole program although nothing is new,
                     or by `scan_once` where an image has no other
    until Q=1 N L    scans until an output has a value, N at most; the one in which it gets it is labelled L
    random N         N scans with random inputs, in which time leaps now and then; the same ones every time
    expect Q=1 R=0   checks outputs
"""

from machine import BadImage

PERIOD_MS = 10


class Missed(Exception):
    """An image answered otherwise than its schedule says."""


class Run:
    """A schedule, played to an image."""

    def __init__(self, machine, path):
        self._machine = machine
        self._inputs, self._outputs = {}, {}
        self._word = self._now_ms = 0
        # Executed instructions by label, and what was at the outputs after each scan but scan 0.
        self.counts = {}
        self.answers = []
        with open(path, encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                words = line.split("#")[0].split()
                if not words:
                    continue
                try:
                    self._obey(*words)
                except Missed as missed:
                    raise Missed(f"{path}:{number}: {machine.path.name}: {missed}") from missed

    def _obey(self, command, *words):
        match command:
            case "in":
                self._inputs = {name: 1 << bit for bit, name in enumerate(words)}
            case "out":
                self._outputs = {name: bit for bit, name in enumerate(words)}
            case "init":
                self._machine.call("bench_init")
            case "set":
                for name, value in pairs(words):
                    self._set(self._inputs[name], value)
            case "all":
                for mask in self._inputs.values():
                    self._set(mask, int(words[0]))
            case "scan":
                self._scans(int(words[0]), words[1] if len(words) > 1 else "other")
            case "rest":
                self._scans(4, "settling")
                self._scans(int(words[0]), "idle")
            case "look":
                look = "look_once" if self._machine.has("look_once") else "scan_once"
                for _ in range(int(words[0])):
                    self._scan("steady", function=look)
            case "until":
                self._until(*pairs(words[:1]), int(words[1]), words[2])
            case "random":
                self._random(int(words[0]))
            case "expect":
                for name, value in pairs(words):
                    if self._output(name) != value:
                        raise Missed(f"{name} is {self._output(name)}, not {value}")
            case _:
                raise BadImage(f"no such command of a schedule: {command}")

    def _set(self, mask, value):
        self._word = self._word | mask if value else self._word & ~mask

    def _output(self, name):
        return self._machine.read("bench_out") >> self._outputs[name] & 1

    def _scan(self, label, after_ms=PERIOD_MS, function="scan_once"):
        self._now_ms += after_ms
        self._machine.write("bench_in", self._word)
        self._machine.write("bench_now_ms", self._now_ms)
        self.counts.setdefault(label, []).append(self._machine.call(function))
        self.answers.append(self._machine.read("bench_out"))

    def _scans(self, count, label):
        for _ in range(count):
            self._scan(label)

    def _until(self, wanted, most, label):
        name, value = wanted
        for _ in range(most):
            self._scan("waiting")
            if self._output(name) == value:
                self.counts.setdefault(label, []).append(self.counts["waiting"].pop())
                return
        raise Missed(f"{name} is not {value} within {most} scans")

    def _random(self, count):
        masks = list(self._inputs.values())
        dice = Dice()
        for _ in range(count):
            if dice.throw(3) == 0:
                self._word ^= masks[dice.throw(len(masks))]
            leap = dice.throw(16) == 0
            self._scan("random", PERIOD_MS * (1 + dice.throw(1600)) if leap else PERIOD_MS)


class Dice:
    """Numbers that look random and are the same with every Python."""

    def __init__(self):
        self._state = 1

    def throw(self, sides):
        """A number below `sides`."""
        self._state = (self._state * 6364136223846793005 + 1442695040888963407) % (1 << 64)
        return (self._state >> 33) % sides


def pairs(words):
    """Names and values of `NAME=VALUE`."""
    return [(name, int(value)) for name, value in (word.split("=") for word in words)]
