//! Short vectors without an allocation.

use crate::kernels::parallel::Buffers;
use std::ops::{Deref, DerefMut};

/// The longest vector on the stack: three of the seven states for which kernels are compiled.
const ON_STACK: usize = 21;

/// Numbers that are kept on the stack where they are few, as the states at one place are: beside what is done
/// with them an allocation is expensive.
#[derive(Clone, Debug)]
pub(crate) struct Few {
    count: usize,
    on_stack: [f64; ON_STACK],
    on_heap: Vec<f64>,
}

impl Few {
    /// This many zeros.
    #[inline(always)]
    pub(crate) fn zeros(count: usize) -> Self {
        Self {
            count,
            on_stack: [0.0; ON_STACK],
            on_heap: match count > ON_STACK {
                true => vec![0.0; count],
                false => vec![],
            },
        }
    }
}

impl Deref for Few {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        match self.count > ON_STACK {
            true => &self.on_heap,
            false => &self.on_stack[..self.count],
        }
    }
}

impl DerefMut for Few {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        match self.count > ON_STACK {
            true => &mut self.on_heap,
            false => &mut self.on_stack[..self.count],
        }
    }
}

/// Scratch space.
impl Buffers for Few {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_and_many_numbers_are_zero_and_keep_what_is_written() {
        for count in [0, 1, ON_STACK, ON_STACK + 1] {
            let mut few = Few::zeros(count);
            assert_eq!(*few, *vec![0.0; count]);
            if let Some(last) = few.last_mut() {
                *last = 2.0;
            }
            assert_eq!(few.iter().sum::<f64>(), if count > 0 { 2.0 } else { 0.0 });
        }
    }
}
