//! The belt at samples that are evenly spaced, for an animation.

use super::history::BeltAlongLoop;

/// Keeps the belt at every sample, every other one, every fourth one and so on, as a number of frames has room for: where a
/// run ends need not be known, and the frames change nothing in it, as steps end at samples in any case.
pub(crate) struct Frames {
    /// Most frames; 0 for none.
    most: usize,
    /// Samples from one frame to the next.
    every: usize,
    kept: Vec<BeltAlongLoop>,
}

impl Frames {
    /// Keeps no more than so many frames.
    pub(crate) fn new(most: usize) -> Self {
        Self {
            most,
            every: 1,
            kept: vec![],
        }
    }

    /// Looks at a sample by its number, with the belt at it.
    pub(crate) fn look(&mut self, sample: usize, belt: impl FnOnce() -> BeltAlongLoop) {
        if self.most == 0 || !sample.is_multiple_of(self.every) {
            return;
        }
        if self.kept.len() == self.most {
            self.every *= 2;
            let mut index = 0..;
            self.kept
                .retain(|_| index.next().is_some_and(|index| index % 2 == 0));
        }
        if sample.is_multiple_of(self.every) {
            self.kept.push(belt());
        }
    }

    /// What is kept, in the order of time.
    pub(crate) fn into_kept(self) -> Vec<BeltAlongLoop> {
        self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of the samples that are kept of so many.
    fn kept(most: usize, samples: usize) -> Vec<f64> {
        let mut frames = Frames::new(most);
        for sample in 0..samples {
            frames.look(sample, || BeltAlongLoop {
                time: sample as f64,
                position: vec![],
                tension: vec![],
                speed: vec![],
                friction: vec![],
                slips: vec![],
                displacement: vec![],
                angular_speeds: vec![],
            });
        }
        let kept = frames.into_kept().into_iter();
        kept.map(|belt| belt.time).collect()
    }

    #[test]
    fn frames_are_evenly_spaced_and_no_more_than_asked_for() {
        assert_eq!(kept(4, 4), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(kept(4, 5), [0.0, 2.0, 4.0]);
        assert_eq!(kept(3, 4), [0.0, 2.0]);
        assert_eq!(kept(3, 12), [0.0, 4.0, 8.0]);
        assert_eq!(kept(3, 14), [0.0, 8.0]);
        assert_eq!(kept(1, 14), [0.0]);
        assert_eq!(kept(0, 14), [0.0; 0]);
        for samples in 1..2000 {
            let kept = kept(200, samples);
            assert!(
                kept.len() <= 200 && kept.len() >= samples.min(100),
                "{samples}"
            );
            let gaps = kept.windows(2).map(|pair| pair[1] - pair[0]);
            let gaps: Vec<_> = gaps.collect();
            assert!(gaps.iter().all(|gap| *gap == gaps[0]), "{samples}");
            // Less than an interval is missing at the end.
            let missing = (samples - 1) as f64 - kept[kept.len() - 1];
            assert!(missing < gaps.first().copied().unwrap_or(1.0), "{samples}");
        }
    }
}
