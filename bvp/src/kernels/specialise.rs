//! Loops whose length the compiler knows.

/// Compiles a call of an inlined function once for each of the listed values of a number and once for
/// any other value. Where the compiler knows the length of the loops it unrolls them, which halves the
/// time of a solution with two states. With `else`, other values get another call.
macro_rules! specialise {
    ($n:ident in [$($value:literal),*] => $call:expr) => {
        $crate::kernels::specialise::specialise!($n in [$($value),*] => $call, else $call)
    };
    ($n:ident in [$($value:literal),*] => $call:expr, else $other:expr) => {
        match $n {
            $($value => {
                let $n: usize = $value;
                $call
            })*
            _ => $other,
        }
    };
}

pub(crate) use specialise;
