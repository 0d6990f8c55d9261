//! Effective sample size of an indicator: a bit a draw, so that an autocovariance is a count.

use super::effective::{geyer_size, sample_variance};

const WORD: usize = u64::BITS as usize;

/// Effective sample size of the mean of the 0–1 series `is_one` says of `draws`, chains of `per_chain` (at least 2); all
/// draws count in full when the answer is the same for all.
pub(super) fn indicator_size(draws: &[f64], per_chain: usize, is_one: impl Fn(f64) -> bool) -> f64 {
    let chains: Vec<Bits> = draws.chunks_exact(per_chain).map(|chain| Bits::pack(chain, &is_one)).collect();
    let ones: usize = chains.iter().map(Bits::ones).sum();
    if ones == 0 || ones == draws.len() {
        return draws.len() as f64;
    }
    let means: Vec<f64> = chains.iter().map(|chain| chain.ones() as f64 / per_chain as f64).collect();
    let n_values = draws.len() as f64;
    geyer_size(chains.len(), per_chain, sample_variance(&means), |lag| {
        chains.iter().map(|chain| chain.centred_products(lag)).sum::<f64>() / n_values
    })
}

/// A chain of bits, the first draw in the lowest bit of the first word, zeros after the last draw.
struct Bits {
    length: usize,
    words: Vec<u64>,
    /// Ones before each word, and at last all of them.
    ones_before: Vec<usize>,
}

impl Bits {
    fn pack(chain: &[f64], is_one: impl Fn(f64) -> bool) -> Self {
        let pack = |draws: &[f64]| draws.iter().rev().fold(0, |word, &x| word << 1 | u64::from(is_one(x)));
        let words: Vec<u64> = chain.chunks(WORD).map(pack).collect();
        let mut ones_before = vec![0];
        for word in &words {
            ones_before.push(ones_before[ones_before.len() - 1] + word.count_ones() as usize);
        }
        Self { length: chain.len(), words, ones_before }
    }

    fn ones(&self) -> usize {
        self.ones_before[self.words.len()]
    }

    /// Ones among the first `count` draws.
    fn ones_in_first(&self, count: usize) -> usize {
        let (whole, rest) = (count / WORD, count % WORD);
        let partial = if rest == 0 { 0 } else { (self.words[whole] << (WORD - rest)).count_ones() as usize };
        self.ones_before[whole] + partial
    }

    /// Draws t for which both t and t + `lag` are ones.
    fn ones_together(&self, lag: usize) -> usize {
        let (whole, rest) = (lag / WORD, lag % WORD);
        let later = self.words[whole..].iter();
        if rest == 0 {
            return self.words.iter().zip(later).map(|(a, b)| (a & b).count_ones() as usize).sum();
        }
        let next = self.words[whole + 1..].iter().chain([&0]);
        let shifted = later.zip(next).map(|(low, high)| low >> rest | high << (WORD - rest));
        self.words.iter().zip(shifted).map(|(a, b)| (a & b).count_ones() as usize).sum()
    }

    /// Σ_t (I_t − p)(I_{t+lag} − p) over the pairs inside the chain, p its share of ones; lag below the length.
    fn centred_products(&self, lag: usize) -> f64 {
        let share = self.ones() as f64 / self.length as f64;
        let earlier = self.ones_in_first(self.length - lag);
        let later = self.ones() - self.ones_in_first(lag);
        let pairs = (self.length - lag) as f64;
        self.ones_together(lag) as f64 - share * ((earlier + later) as f64 - share * pairs)
    }
}

#[cfg(test)]
mod tests {
    use super::indicator_size;
    use crate::effective::effective_size;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn counting_agrees_with_multiplying(
            draws in proptest::collection::vec(0_u8..3, 400..401),
            sticky in 1_usize..40,
            n_chains in 0_usize..4,
        ) {
            // Runs of equal draws, so that many lags are asked for.
            let draws: Vec<f64> = (0..draws.len()).map(|i| f64::from(draws[i / sticky])).collect();
            let per_chain = draws.len() / [1, 2, 4, 5][n_chains];
            let zero_one: Vec<f64> = draws.iter().map(|&x| if x < 0.5 { 1.0 } else { 0.0 }).collect();
            let (counted, multiplied) =
                (indicator_size(&draws, per_chain, |x| x < 0.5), effective_size(&zero_one, per_chain));
            prop_assert!((counted / multiplied - 1.0).abs() < 1e-10, "{counted} vs {multiplied}");
        }
    }
}
