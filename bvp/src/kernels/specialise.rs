//! Loops whose length the compiler knows.

/// Evaluates a call of a function that is always inlined, once for each of the small values that a
/// number often has and once for any value: where the compiler knows how long the loops are, it
/// unrolls them. Half of the time of a solution with two states is won by it. With `else`, any other
/// value is left to another call.
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
