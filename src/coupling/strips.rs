//! The capacitance between two strips of copper side by side on a board, by conformal mapping.
//!
//! ```text
//!     w₁        gap s       w₂            Air above, a board of thickness h and permittivity ε below, air
//!  ▓▓▓▓▓▓▓▓▓             ▓▓▓▓▓▓▓▓▓▓▓      again. Copper has no thickness, strips are long beside the gap.
//!  ░░░░░░░░░░░░░░░░░░░░░░░░░░░░░░░░░ h
//! ```
//!
//! A half-plane with two electrodes on its edge is mapped onto a rectangle whose opposite sides
//! they are; its capacitance per unit length is ε₀ K(k′)/K(k), with the complete elliptic integral
//! of the first kind K, k′ = √(1 − k²), and for the ends of the electrodes as they lie, a cross
//! ratio:
//!
//! ```text
//!        s (w₁ + s + w₂)
//!  k² = ─────────────────          k′² = w₁ w₂ ÷ the same
//!       (w₁ + s) (s + w₂)
//! ```
//!
//! Air has two half-planes. What the board adds, ε − 1 times a slab of its thickness, is mapped
//! onto a half-plane by exp(πz/h) first, which makes sinh(πx/2h) of each length x:
//!
//! ```text
//!  C/l = ε₀ [ 2 K(k₀′)/K(k₀) + (ε − 1) K(k₁′)/K(k₁) ]
//! ```
//!
//! That is the method of partial capacitances: C. Karpuz, A. Görür: *Fast and simple analytical
//! expressions for quasi-static parameters of asymmetric coplanar lines*, Microwave and Optical
//! Technology Letters 9(6), 1995, p. 334–336. It takes the underside of the board for a line of the
//! field. Beside charges found numerically with all their images in the board (the test below) it
//! is short by up to 6 % where the gap is at most a quarter of the board's thickness, as between
//! regions, and by up to 14 % where it is a few times that.
//!
//! K(k′)/K(k) = agm(1, k′)/agm(1, k), the arithmetic-geometric mean (Abramowitz, Stegun: *Handbook
//! of Mathematical Functions*, 17.6).

/// The permittivity of the vacuum, in picofarads a millimetre.
const VACUUM: f64 = 8.854_187_8e-3;

/// What strips lie on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Substrate {
    /// Its permittivity, relative to that of the vacuum.
    pub permittivity: f64,
    /// Its thickness in millimetres.
    pub thickness: f64,
}

impl Substrate {
    /// FR-4 of this thickness in millimetres. Its permittivity is 4.2 to 4.8, by maker and
    /// frequency; the middle is taken.
    #[must_use]
    pub const fn fr4(thickness: f64) -> Self {
        Self { permittivity: 4.5, thickness }
    }
}

/// The capacitance in picofarads a millimetre between two strips `widths` wide, `gap` apart, all in
/// millimetres and more than zero.
#[must_use]
pub fn capacitance(gap: f64, widths: [f64; 2], substrate: Substrate) -> f64 {
    let [one, other] = widths;
    let plain = ratio(
        gap * (one + gap + other) / ((one + gap) * (gap + other)),
        one * other / ((one + gap) * (gap + other)),
    );
    let Substrate { permittivity, thickness } = substrate;
    // sinh(x) without its power of e, which cancels in k² and leaves that of the gap in k′².
    let scale = std::f64::consts::PI / thickness;
    let sinh = |length: f64| -libm::expm1(-length * scale);
    let below = sinh(one + gap) * sinh(gap + other);
    let board = ratio(
        sinh(gap) * sinh(one + gap + other) / below,
        libm::exp(-gap * scale) * sinh(one) * sinh(other) / below,
    );
    VACUUM * (2.0 * plain + (permittivity - 1.0) * board)
}

/// K(k′)/K(k), from k² and k′².
fn ratio(modulus: f64, complement: f64) -> f64 {
    mean(complement.max(0.0).sqrt()) / mean(modulus.min(1.0).sqrt())
}

/// The arithmetic-geometric mean of one and `other`, which is at most one.
fn mean(other: f64) -> f64 {
    let (mut a, mut b) = (1.0, other.max(f64::MIN_POSITIVE));
    // Each step doubles the digits that agree.
    while a - b > 1e-14 * a {
        (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The potential of a line of charge on the top of a board, at the distance `x` on its top, in
    /// units of charge ÷ (2π ε₀): the charge, and its images in the underside and the top, each
    /// fainter by (ε − 1)/(ε + 1).
    fn potential(x: f64, substrate: Substrate) -> f64 {
        let e = substrate.permittivity;
        let fainter = (e - 1.0) / (e + 1.0);
        let (mut sum, mut strength, mut depth) = (libm::log(x), 1.0, 0.0);
        for _ in 0..60 {
            depth += 2.0 * substrate.thickness;
            let far = libm::log((x * x + depth * depth).sqrt());
            sum += strength * fainter * (1.0 + fainter) * far;
            strength *= fainter * fainter;
        }
        -2.0 / (e + 1.0) * sum
    }

    /// The same capacitance from charges on many narrow lines (the method of moments): no mapping.
    fn by_charges(gap: f64, widths: [f64; 2], substrate: Substrate) -> f64 {
        const LINES: usize = 60;
        // Lines crowd at the ends of strips, where the charge does.
        let strip = |from: f64, width: f64| {
            (0..LINES).map(move |i| {
                let at = |i: usize| {
                    let part = std::f64::consts::PI * f64::from(u32::try_from(i).unwrap()) / 60.0;
                    from + width * (1.0 - libm::cos(part)) / 2.0
                };
                (f64::midpoint(at(i), at(i + 1)), at(i + 1) - at(i))
            })
        };
        let lines: Vec<(f64, f64)> = strip(0.0, widths[0]).chain(strip(widths[0] + gap, widths[1])).collect();
        let n = lines.len();
        // Unknown: each charge, and the potential of infinity; known: one volt, no charge in all.
        let mut matrix = vec![vec![0.0; n + 2]; n + 1];
        for (i, &(x, width)) in lines.iter().enumerate() {
            for (j, &(other, _)) in lines.iter().enumerate() {
                // A line as wide as `width` is at its own place as one at width ÷ 2e.
                let apart = if i == j { width / (2.0 * std::f64::consts::E) } else { (x - other).abs() };
                matrix[i][j] = potential(apart, substrate);
            }
            matrix[i][n] = 1.0;
            matrix[i][n + 1] = if i < LINES { 1.0 } else { 0.0 };
            matrix[n][i] = 1.0;
        }
        for pivot in 0..=n {
            let best = (pivot..=n).max_by(|&a, &b| matrix[a][pivot].abs().total_cmp(&matrix[b][pivot].abs()));
            matrix.swap(pivot, best.unwrap());
            let row = matrix[pivot].clone();
            for (i, other) in matrix.iter_mut().enumerate().filter(|(i, _)| *i != pivot) {
                let factor = other[pivot] / row[pivot];
                assert!(factor.is_finite(), "row {i} has a solution");
                other.iter_mut().zip(&row).for_each(|(value, known)| *value -= factor * known);
            }
        }
        let charge: f64 = (0..LINES).map(|i| matrix[i][n + 1] / matrix[i][i]).sum();
        charge * 2.0 * std::f64::consts::PI * VACUUM
    }

    #[test]
    fn the_mapping_agrees_with_charges_and_their_images() {
        for thickness in [0.8, 1.6] {
            for gap in [0.1, 0.2, 0.5, 1.0, 3.0] {
                for widths in [[0.2, 0.2], [0.2, 1.0], [0.5, 5.0], [3.0, 3.0], [1.0, 20.0]] {
                    let substrate = Substrate::fr4(thickness);
                    let (found, judged) =
                        (capacitance(gap, widths, substrate), by_charges(gap, widths, substrate));
                    let short = 1.0 - found / judged;
                    let most = if gap <= thickness / 4.0 { 0.06 } else { 0.14 };
                    assert!((0.0..most).contains(&short), "{gap} {widths:?}: {found}, not {judged}");
                }
            }
        }
    }

    #[test]
    fn alone_in_air_and_on_an_endless_board_it_is_exact() {
        let thick = |permittivity| Substrate { permittivity, thickness: 1e4 };
        for (gap, widths) in [(0.2, [0.3, 0.3]), (0.1, [2.0, 0.2])] {
            let air = capacitance(gap, widths, thick(1.0));
            assert!((air / by_charges(gap, widths, thick(1.0)) - 1.0).abs() < 2e-3, "{gap} {widths:?}");
            let board = capacitance(gap, widths, thick(4.5));
            assert!(
                (board / air - 2.75).abs() < 1e-3,
                "half of the field runs in the board: {}",
                board / air
            );
        }
        // Strips as wide as the gap have k² = 3/4 in the cross ratio: a value from a table of K.
        let known = 2.0 * VACUUM * 1.685_750_354_812_596 / 2.156_515_647_499_643;
        let found = capacitance(1.0, [1.0, 1.0], Substrate { permittivity: 1.0, thickness: 1.0 });
        assert!((found / known - 1.0).abs() < 1e-12, "{found}, not {known}");
    }
}
