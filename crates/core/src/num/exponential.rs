//! The one exponential of the project.
//!
//! Only +, − and × of IEEE 754 are used, in a fixed order and never fused, so every target and every optimisation level
//! gives the same bits.

use crate::num::lane::{LANES, Lane};
use crate::num::scaled::Scaled;

/// Below this, `eˣ` is less than 2⁻¹⁰²² and counts as 0 in `f64`.
const EXP_IS_ZERO: f64 = -710.0;

/// `eˣ` within 1 unit in the last place; 0 below 2⁻¹⁰²¹ and infinity above the largest `f64`.
#[inline]
#[must_use]
pub fn exp(x: f64) -> f64 {
    match x.abs() {
        ..=ORDINARY => exp_ordinary(x),
        _ if x < EXP_IS_ZERO => 0.0,
        _ => exp_scaled(x).value(),
    }
}

/// `eˣ` of several numbers at once, with the bits of [`exp`], and with fewer instructions where all are ordinary.
#[inline]
#[must_use]
pub(crate) fn exps<const L: usize>(x: [f64; L]) -> [f64; L] {
    if x.iter().all(|x| x.abs() <= ORDINARY) { x.map(exp_ordinary) } else { x.map(exp) }
}

/// `eˣ` in every lane, with the bits of [`exp`]. Numbers whose exponential vanishes do not keep the others from the short way.
#[inline]
#[must_use]
pub(crate) fn exps_in_lanes(x: &Lane) -> Lane {
    if are_ordinary(x) { ordinary_in_lanes(x) } else { far_in_lanes(x) }
}

#[cold]
fn far_in_lanes(x: &Lane) -> Lane {
    let near = x.map(|x| if x < EXP_IS_ZERO { 0.0 } else { x });
    if !are_ordinary(&near) {
        return x.map(exp);
    }
    let mut powers = ordinary_in_lanes(&near);
    for k in 0..LANES {
        powers[k] = if x[k] < EXP_IS_ZERO { 0.0 } else { powers[k] };
    }
    powers
}

#[inline]
fn are_ordinary(x: &Lane) -> bool {
    let mut all = true;
    for x in x {
        all &= x.abs() <= ORDINARY;
    }
    all
}

/// Loops are apart, because what looks up roots is not vectorised and all else is.
#[inline]
fn ordinary_in_lanes(x: &Lane) -> Lane {
    let (mut steps, mut powers) = ([0; LANES], [0.0; LANES]);
    let (mut roots, mut tails) = ([0.0; LANES], [0.0; LANES]);
    for k in 0..LANES {
        (steps[k], tails[k]) = split(x[k]);
    }
    for k in 0..LANES {
        roots[k] = scaled_root(steps[k]);
    }
    for k in 0..LANES {
        powers[k] = roots[k] + roots[k] * tails[k];
    }
    powers
}

/// True where every `eˣ` counts as 0.
#[inline]
#[must_use]
pub(crate) fn vanish(x: &[f64]) -> bool {
    x.iter().all(|x| *x < EXP_IS_ZERO)
}

/// Beyond this |x| the exponent of `eˣ` saturates: far outside anything `f64` holds, far inside `i32`.
const EXPONENT_LIMIT: f64 = 1e8;

/// `eˣ` as mantissa and binary exponent, so that it neither overflows nor vanishes.
///
/// ```text
/// x = (64 k + m) ln 2/64 + r,   |r| ≤ ln 2/128,   0 ≤ m < 64
/// eˣ = 2ᵏ · 2^(m/64) (1 + r + r²/2! + r³/3! + r⁴/4! + r⁵/5!)
/// ```
///
/// The rest of the series is below 2⁻⁵⁴. Beyond |x| = 10⁵ the error grows with |x|, as that of x itself does.
/// Saturates at `x = ±10⁸`; NaN counts as −10⁸.
#[inline]
#[must_use]
pub fn exp_scaled(x: f64) -> Scaled {
    let x = x.max(-EXPONENT_LIMIT).min(EXPONENT_LIMIT);
    let (steps, tail) = split(x);
    // The leading bits of ROUND are shifted out, the sign of the steps comes down.
    #[expect(clippy::cast_possible_truncation, reason = "below 2e8 by the limit above")]
    let exponent = ((steps << 13).cast_signed() >> 19) as i32;
    let root = f64::from_bits(root(steps));
    Scaled { mantissa: root + root * tail, exponent }
}

/// `eˣ` for |x| up to [`ORDINARY`], with the bits of [`exp_scaled`]: the exponent is added to that of the root.
#[inline]
pub(crate) fn exp_ordinary(x: f64) -> f64 {
    let (steps, tail) = split(x);
    let root = scaled_root(steps);
    root + root * tail
}

/// `2ᵏ · 2^(m/64)`, where that is an ordinary `f64`.
#[inline]
fn scaled_root(steps: u64) -> f64 {
    f64::from_bits(root(steps).wrapping_add(steps >> 6 << 52))
}

/// Up to this |x|, `eˣ` and each part of its sum are ordinary `f64`.
pub(crate) const ORDINARY: f64 = 700.0;

/// Bits whose lowest 51 are those of `64 k + m`, and `eʳ − 1`.
#[inline]
fn split(x: f64) -> (u64, f64) {
    const STEPS_PER_UNIT: f64 = 92.332_482_616_893_66; // 64/ln 2
    const STEP_HIGH: f64 = 0.010_830_424_609_594_047; // the leading 27 bits of ln 2/64
    const STEP_LOW: f64 = 8.665_509_839_009_47e-11;
    const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5·2⁵²: adding it rounds to an integer
    let rounded = x * STEPS_PER_UNIT + ROUND;
    let steps = rounded - ROUND;
    let r = (x - steps * STEP_HIGH) - steps * STEP_LOW;
    let r2 = r * r;
    let tail = r + r2 * (0.5 + r * (1.0 / 6.0)) + r2 * r2 * (1.0 / 24.0 + r * (1.0 / 120.0));
    (rounded.to_bits(), tail)
}

/// Bits of `2^(m/64)`.
#[inline]
fn root(steps: u64) -> u64 {
    ROOTS[usize::from(steps.to_le_bytes()[0] & 63)]
}

/// Bits of `2^(m/64)`, correctly rounded: `[struct.unpack('<Q', struct.pack('<d', float((ln2 * m / 64).exp())))[0]
/// for m in range(64)]` with Python's `decimal` at 60 digits.
const ROOTS: [u64; 64] = [
    0x3ff0_0000_0000_0000,
    0x3ff0_2c9a_3e77_8061,
    0x3ff0_59b0_d315_8574,
    0x3ff0_8745_1875_9bc8,
    0x3ff0_b558_6cf9_890f,
    0x3ff0_e3ec_32d3_d1a2,
    0x3ff1_1301_d012_5b51,
    0x3ff1_429a_aea9_2de0,
    0x3ff1_72b8_3c7d_517b,
    0x3ff1_a35b_eb6f_cb75,
    0x3ff1_d487_3168_b9aa,
    0x3ff2_063b_8862_8cd6,
    0x3ff2_387a_6e75_6238,
    0x3ff2_6b45_65e2_7cdd,
    0x3ff2_9e9d_f51f_dee1,
    0x3ff2_d285_a6e4_030b,
    0x3ff3_06fe_0a31_b715,
    0x3ff3_3c08_b264_16ff,
    0x3ff3_71a7_373a_a9cb,
    0x3ff3_a7db_34e5_9ff7,
    0x3ff3_dea6_4c12_3422,
    0x3ff4_160a_21f7_2e2a,
    0x3ff4_4e08_6061_892d,
    0x3ff4_86a2_b5c1_3cd0,
    0x3ff4_bfda_d536_2a27,
    0x3ff4_f9b2_769d_2ca7,
    0x3ff5_342b_569d_4f82,
    0x3ff5_6f47_36b5_27da,
    0x3ff5_ab07_dd48_5429,
    0x3ff5_e76f_15ad_2148,
    0x3ff6_247e_b03a_5585,
    0x3ff6_6238_8255_2225,
    0x3ff6_a09e_667f_3bcd,
    0x3ff6_dfb2_3c65_1a2f,
    0x3ff7_1f75_e8ec_5f74,
    0x3ff7_5feb_5642_67c9,
    0x3ff7_a114_73eb_0187,
    0x3ff7_e2f3_36cf_4e62,
    0x3ff8_2589_994c_ce13,
    0x3ff8_68d9_9b44_92ed,
    0x3ff8_ace5_422a_a0db,
    0x3ff8_f1ae_9915_7736,
    0x3ff9_3737_b0cd_c5e5,
    0x3ff9_7d82_9fde_4e50,
    0x3ff9_c491_82a3_f090,
    0x3ffa_0c66_7b5d_e565,
    0x3ffa_5503_b23e_255d,
    0x3ffa_9e6b_5579_fdbf,
    0x3ffa_e89f_995a_d3ad,
    0x3ffb_33a2_b84f_15fb,
    0x3ffb_7f76_f2fb_5e47,
    0x3ffb_cc1e_904b_c1d2,
    0x3ffc_199b_dd85_529c,
    0x3ffc_67f1_2e57_d14b,
    0x3ffc_b720_dcef_9069,
    0x3ffd_072d_4a07_897c,
    0x3ffd_5818_dcfb_a487,
    0x3ffd_a9e6_03db_3285,
    0x3ffd_fc97_337b_9b5f,
    0x3ffe_502e_e78b_3ff6,
    0x3ffe_a4af_a2a4_90da,
    0x3ffe_fa1b_ee61_5a27,
    0x3fff_5076_5b6e_4540,
    0x3fff_a7c1_819e_90d8,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roots_are_powers_of_two() {
        for (m, bits) in (0_u32..).zip(ROOTS) {
            let exact = libm::exp2(f64::from(m) / 64.0);
            assert!(bits.abs_diff(exact.to_bits()) <= 1, "2^({m}/64)");
        }
    }

    #[test]
    fn exp_agrees_with_libm_to_one_unit_in_the_last_place() {
        let mut worst = 0;
        for step in 0..400_000 {
            let x = -700.0 + f64::from(step) * 0.003_5;
            let ulps = exp(x).to_bits().abs_diff(libm::exp(x).to_bits());
            worst = worst.max(ulps);
        }
        assert!(worst <= 2, "{worst} units apart, and libm itself may be off by one");
    }

    #[test]
    fn both_ways_to_the_exponential_give_the_same_bits() {
        for step in 0..400_000 {
            let x = -ORDINARY + f64::from(step) * (2.0 * ORDINARY / 399_999.0);
            assert_eq!(exp_ordinary(x).to_bits(), exp_scaled(x).value().to_bits(), "{x}");
        }
    }

    #[test]
    fn lanes_have_the_bits_of_each() {
        let strange = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -705.0, -0.0, 708.0, 1e300, -710.0];
        for step in 0..4_000_u32 {
            let mut x: Lane = core::array::from_fn(|k| {
                let k = u32::try_from(k).unwrap();
                -1000.0 + f64::from((step * 7919 + k * 104_729) % 170_001) * 0.01
            });
            if step % 5 == 0 {
                x[(step / 5 % 16) as usize] = strange[(step / 80 % 8) as usize];
            }
            assert_eq!(exps_in_lanes(&x).map(f64::to_bits), x.map(|x| exp(x).to_bits()), "{x:?}");
        }
    }

    #[test]
    fn exp_saturates_and_never_gives_nan() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-800.0), 0.0);
        assert_eq!(exp(800.0), f64::INFINITY);
        assert_eq!(exp(f64::NEG_INFINITY), 0.0);
        assert_eq!(exp(f64::INFINITY), f64::INFINITY);
        assert_eq!(exp(f64::NAN), 0.0);
    }

    #[test]
    fn exp_scaled_goes_where_f64_cannot() {
        let product = exp_scaled(-5_000.0).times(exp_scaled(5_001.0)).value();
        assert!((product - core::f64::consts::E).abs() < 1e-11, "{product}");
    }
}
