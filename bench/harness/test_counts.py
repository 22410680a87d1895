"""What the comparisons and the reading of code promise."""

import unittest
from dataclasses import replace

from bounds import judge, stimuli
from counts import Counts, compare, to_text
from cortex_m import instructions
from large import sequences
from pico import Size

BEFORE = Counts(20, 90, 100, 120, 130, 200, 2000, 3000, 128)


def compared(**changes):
    """The answer for counts that have changed since they were checked in."""
    kept = to_text({("saw", "m4"): BEFORE})
    return compare(kept, {("saw", "m4"): replace(BEFORE, **changes)})


class Comparison(unittest.TestCase):
    """script/bench --check."""

    def test_equal_counts_pass(self):
        self.assertEqual(compared(), ([], []))

    def test_five_percent_more_pass(self):
        self.assertEqual(compared(steady=105), ([], []))

    def test_more_than_five_percent_is_wrong(self):
        self.assertEqual(compared(steady=106), (["saw m4 steady: 100 -> 106"], []))

    def test_fewer_instructions_are_told_and_pass(self):
        self.assertEqual(compared(steady=94), ([], ["saw m4 steady: 100 -> 94"]))

    def test_a_program_without_checked_in_counts_is_wrong(self):
        wrong, _ = compare("", {("saw", "m4"): BEFORE})
        self.assertIn("saw m4 idle: not in the counts file", wrong)

    def test_a_program_that_is_no_longer_counted_is_wrong(self):
        wrong, _ = compare(to_text({("saw", "m4"): BEFORE}), {})
        self.assertIn("saw m4 idle: in the counts file, and not counted", wrong)


    def test_a_whole_image_is_held_to_its_size(self):
        whole = {("saw", "pico"): Size(40_000, 8_000)}
        kept = to_text(whole)
        self.assertEqual(compare(kept, whole), ([], []))
        grown = {("saw", "pico"): Size(40_000, 8_401)}
        self.assertEqual(compare(kept, grown), (["saw pico ram: 8000 -> 8401"], []))


class Large(unittest.TestCase):
    """The large program."""

    def test_a_hundred_of_a_thousand_steps_are_active(self):
        few = sequences(0)
        self.assertEqual((len(few), sum(it.length for it in few)), (100, 1000))
        self.assertTrue(all(it.awake for it in few))

    def test_sleeping_steps_come_in_addition_and_have_an_output_each(self):
        asleep = [it for it in sequences(10_000) if not it.awake]
        self.assertEqual(sum(it.length for it in asleep), 10_000)
        self.assertTrue(all(it.output(step) for it in asleep for step in it.steps()))

    def test_no_step_waits_for_the_input_that_nothing_reads(self):
        inputs = {it.trigger(step) for it in sequences(10_000) for step in it.steps()}
        self.assertEqual(inputs, set(range(31)))


class Bounds(unittest.TestCase):
    """What is held against `grafcet bound`."""

    def test_a_bound_holds_when_it_is_reached_and_up_to_twice_that(self):
        self.assertIsNone(judge(100, 100))
        self.assertIsNone(judge(100, 200))

    def test_a_bound_that_is_exceeded_is_wrong(self):
        self.assertEqual(judge(101, 100), "a scan took 101 instructions, 100 are stated as the most")

    def test_a_bound_of_more_than_twice_what_is_reached_is_wrong(self):
        self.assertIn("more than 2 times", judge(100, 201))

    def test_every_input_is_seen_in_both_states_and_time_leaps(self):
        words, times = zip(*stimuli(3))
        self.assertEqual(set(words), set(range(8)))
        self.assertEqual(min(times), 10)
        self.assertGreater(max(times), 10_000)


class Code(unittest.TestCase):
    """Counting instructions."""

    def test_short_and_long_instructions_count_one_each(self):
        # movs r0, #1; bl .+4; bx lr
        self.assertEqual(instructions(bytes.fromhex("0120 00f000f8 7047")), 3)


if __name__ == "__main__":
    unittest.main()
