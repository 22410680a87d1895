//! Which of some things can be together, and the heaviest of them that can.

/// A symmetric relation: who can be together with whom. Who cannot be with itself is never there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Together {
    rows: Vec<Vec<u64>>,
}

/// Branches after which the search gives up and takes what is surely not exceeded.
const MOST_BRANCHES: u32 = 20_000;

impl Together {
    /// Nobody with anybody.
    #[must_use]
    pub fn none(size: usize) -> Self {
        Together {
            rows: vec![vec![0; size.div_ceil(64)]; size],
        }
    }

    /// Everybody with everybody.
    #[must_use]
    pub fn all(size: usize) -> Self {
        let mut together = Together::none(size);
        for left in 0..size {
            for right in left..size {
                together.join(left, right);
            }
        }
        together
    }

    /// How many there are.
    #[must_use]
    pub fn size(&self) -> usize {
        self.rows.len()
    }

    /// Whether two can be together; whether one is ever there.
    #[must_use]
    pub fn are(&self, left: usize, right: usize) -> bool {
        let row = self.rows.get(left).and_then(|row| row.get(right / 64));
        row.is_some_and(|word| word >> (right % 64) & 1 != 0)
    }

    /// Lets two be together, and tells whether that is new.
    pub fn join(&mut self, left: usize, right: usize) -> bool {
        let new = !self.are(left, right);
        for (one, other) in [(left, right), (right, left)] {
            let row = self.rows.get_mut(one);
            if let Some(word) = row.and_then(|row| row.get_mut(other / 64)) {
                *word |= 1 << (other % 64);
            }
        }
        new
    }

    /// Those that can be there together with all of these.
    pub fn with_all<'a>(&'a self, these: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
        let all = |one: &usize| self.are(*one, *one) && these.iter().all(|it| self.are(*it, *one));
        (0..self.size()).filter(all)
    }

    /// Those, so many at most, whose weights are together the most that can be there at once; where that takes too long to find, some
    /// whose weights are surely not less.
    #[must_use]
    pub fn heaviest(&self, weights: &[u64], most: usize) -> Vec<usize> {
        let weight = |one: usize| weights.get(one).copied().unwrap_or(0);
        let mut there: Vec<usize> = (0..self.size())
            .filter(|one| self.are(*one, *one) && weight(*one) > 0)
            .collect();
        there.sort_by_key(|one| (std::cmp::Reverse(weight(*one)), *one));
        let mut search = Search {
            together: self,
            weights,
            best: Vec::new(),
            heaviest: 0,
            most,
            branches: 0,
        };
        search.branch(&there, &mut Vec::new(), 0);
        let mut found = match search.branches > MOST_BRANCHES {
            true => self.one_of_each(&there, most),
            false => search.best,
        };
        found.sort_unstable();
        found
    }

    /// Parts them into groups of which only one can be there at a time, and gives the first of each group, of
    /// so many groups at most: the heaviest, when these are in the order of their weights.
    fn one_of_each(&self, these: &[usize], most: usize) -> Vec<usize> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for &one in these {
            let apart = |group: &&mut Vec<usize>| group.iter().all(|it| !self.are(*it, one));
            match groups.iter_mut().find(apart) {
                Some(group) => group.push(one),
                None => groups.push(vec![one]),
            }
        }
        let firsts = groups.iter().filter_map(|group| group.first());
        firsts.take(most).copied().collect()
    }
}

/// Looks for the heaviest.
struct Search<'a> {
    together: &'a Together,
    weights: &'a [u64],
    best: Vec<usize>,
    heaviest: u64,
    most: usize,
    branches: u32,
}

impl Search<'_> {
    /// Adds to what has been taken any of the rest, the heaviest of which come first.
    fn branch(&mut self, rest: &[usize], taken: &mut Vec<usize>, weight: u64) {
        if weight > self.heaviest {
            self.heaviest = weight;
            self.best.clone_from(taken);
        }
        let mut rest = rest;
        while let [first, behind @ ..] = rest {
            let places = self.most.saturating_sub(taken.len());
            let most = self.together.one_of_each(rest, places);
            let most: u64 = most.into_iter().map(|one| self.weight(one)).sum();
            if weight + most <= self.heaviest || self.branches > MOST_BRANCHES {
                return;
            }
            self.branches += 1;
            let fits = |one: &usize| self.together.are(*one, *first);
            let with: Vec<usize> = behind.iter().copied().filter(fits).collect();
            taken.push(*first);
            self.branch(&with, taken, weight + self.weight(*first));
            taken.pop();
            rest = behind;
        }
    }

    fn weight(&self, one: usize) -> u64 {
        self.weights.get(one).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn related(size: usize, pairs: &[(usize, usize)]) -> Together {
        let mut together = Together::none(size);
        for one in 0..size {
            together.join(one, one);
        }
        for (left, right) in pairs {
            together.join(*left, *right);
        }
        together
    }

    #[test]
    fn of_those_that_are_never_together_the_heaviest_is_taken() {
        assert_eq!(related(3, &[]).heaviest(&[2, 5, 3], usize::MAX), [1]);
    }

    #[test]
    fn two_together_outweigh_a_heavier_one() {
        assert_eq!(
            related(3, &[(0, 2)]).heaviest(&[3, 5, 3], usize::MAX),
            [0, 2]
        );
    }

    #[test]
    fn a_ring_of_pairs_is_not_taken_for_all_of_them_together() {
        let ring = related(4, &[(0, 1), (1, 2), (2, 3), (3, 0)]);
        assert_eq!(ring.heaviest(&[1, 1, 1, 2], usize::MAX), [0, 3]);
    }

    #[test]
    fn no_more_are_taken_than_can_be_there() {
        let all = Together::all(4);
        assert_eq!(all.heaviest(&[1, 4, 2, 3], 2), [1, 3]);
    }

    #[test]
    fn who_is_never_there_weighs_nothing() {
        let mut together = Together::none(2);
        together.join(0, 0);
        assert_eq!(together.heaviest(&[1, 100], usize::MAX), [0]);
    }

    #[test]
    fn a_search_that_takes_too_long_ends_with_what_is_not_exceeded() {
        // Fifty groups of three of which one each can be there, and of neighbouring groups none of the same rank.
        let size = 150;
        let mut together = Together::none(size);
        for left in 0..size {
            for right in left..size {
                let (one, other) = (left / 3, right / 3);
                let clash = other == one + 1 && left % 3 == right % 3;
                if left == right || one != other && !clash {
                    together.join(left, right);
                }
            }
        }
        let weights: Vec<u64> = (0..150).map(|one| 10 + one * 7 % 11).collect();
        let heaviest = together.heaviest(&weights, usize::MAX);
        let found: u64 = heaviest.iter().filter_map(|one| weights.get(*one)).sum();
        let of_rank = |rank: usize| {
            (0..50)
                .map(|group| weights[group * 3 + (rank + group) % 3])
                .sum()
        };
        let some: Vec<u64> = (0..3).map(of_rank).collect();
        assert!(some.iter().all(|sum| *sum <= found), "{found} {some:?}");
    }
}
