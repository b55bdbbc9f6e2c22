//! One or two machine words of bits, so that the search of a graph of 64 nodes or fewer does not pay for 128.

use core::ops::{BitAnd, BitOr, Not};

/// A row of bits.
pub(crate) trait Word:
    Copy + Eq + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    const NONE: Self;

    fn from_bits(bits: u128) -> Self;
    fn bits(self) -> u128;
    fn one(node: usize) -> Self;
    fn count(self) -> i32;
    fn lowest(self) -> usize;
    fn without_lowest(self) -> Self;

    fn is_none(self) -> bool {
        self == Self::NONE
    }

    fn without(self, other: Self) -> Self {
        self & !other
    }

    fn is_within(self, other: Self) -> bool {
        self.without(other).is_none()
    }

    fn nodes(self) -> Nodes<Self> {
        Nodes(self)
    }
}

/// The members of a word, least first.
pub(crate) struct Nodes<W>(W);

impl<W: Word> Iterator for Nodes<W> {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        if self.0.is_none() {
            return None;
        }
        let node = self.0.lowest();
        self.0 = self.0.without_lowest();
        Some(node)
    }
}

macro_rules! word {
    ($bits:ty, $cast:expr) => {
        impl Word for $bits {
            const NONE: Self = 0;

            fn from_bits(bits: u128) -> Self {
                $cast(bits)
            }

            fn bits(self) -> u128 {
                u128::from(self)
            }

            fn one(node: usize) -> Self {
                1 << node
            }

            fn count(self) -> i32 {
                self.count_ones().cast_signed()
            }

            fn lowest(self) -> usize {
                self.trailing_zeros() as usize
            }

            fn without_lowest(self) -> Self {
                self & (self - 1)
            }
        }
    };
}

word!(u64, |bits: u128| u64::try_from(bits & u128::from(u64::MAX)).unwrap_or(u64::MAX));
word!(u128, |bits: u128| bits);
