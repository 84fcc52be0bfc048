//! Loops whose length the compiler knows.

/// Compiles a call of an inlined function once for each of the listed values of a number and once for
/// any other value. Where the compiler knows the length of the loops it unrolls them, which halves the
/// time of a solution with two states. With `else`, other values get another call.
///
/// The number is a constant in the call, so that a call that is [`outlined`] knows it, too.
macro_rules! specialise {
    ($n:ident in [$($value:literal),*] => $call:expr) => {
        $crate::kernels::specialise::specialise!($n in [$($value),*] => $call, else $call)
    };
    ($n:ident in [$($value:literal),*] => $call:expr, else $other:expr) => {
        match $n {
            $($value => {
                #[allow(non_upper_case_globals, reason = "the name is that of the number")]
                const $n: usize = $value;
                $call
            })*
            _ => $other,
        }
    };
}

pub(crate) use specialise;

/// Makes a call in a function of its own, for work on all intervals of a run. With all copies of such work in one function, of which
/// the largest had a megabyte, the crate takes twice as long to compile and the reference problems 3 to 4 % longer to solve.
#[inline(never)]
pub(crate) fn outlined<R>(call: impl FnOnce() -> R) -> R {
    call()
}
