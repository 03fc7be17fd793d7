//! Two classes of samples, by Otsu's method.

use super::Field;

/// What parts the samples of a picture into two classes, and how well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Midway between the classes: what a pixel has that is half of each.
    pub middle: u16,
    /// The mean of the lower class.
    pub low: f64,
    /// The mean of the higher class.
    pub high: f64,
    /// The part of the samples in the higher class.
    pub share: f64,
    /// How much of the variance lies between the classes: 1 where there are but two values.
    pub separation: f64,
}

/// The two classes; none where all samples are alike.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "counts of pixels are below 2⁵³")]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two samples")]
pub fn level(field: &Field) -> Option<Level> {
    let mut counts = vec![0_u64; 1 << 16];
    field.samples().iter().for_each(|&sample| counts[usize::from(sample)] += 1);
    let all = field.samples().len() as f64;
    let sum = |weight: fn(f64) -> f64| -> f64 {
        counts.iter().zip(0_u32..).map(|(&count, value)| count as f64 * weight(f64::from(value))).sum()
    };
    let mean = sum(|value| value) / all;
    let variance = sum(|value| value * value) / all - mean * mean;
    let (mut below, mut weighted) = (0.0, 0.0);
    let mut best: Option<(f64, Level)> = None;
    for (&count, value) in counts.iter().zip(0_u32..) {
        below += count as f64;
        weighted += count as f64 * f64::from(value);
        if count == 0 || below >= all {
            continue;
        }
        let (low, high) = (weighted / below, (mean * all - weighted) / (all - below));
        let share = 1.0 - below / all;
        let between = share * (1.0 - share) * (high - low) * (high - low);
        if best.is_none_or(|(most, _)| between > most) {
            let middle = f64::midpoint(low, high) as u16;
            let separation = if variance > 0.0 { between / variance } else { 0.0 };
            best = Some((between, Level { middle, low, high, share, separation }));
        }
    }
    best.map(|(_, level)| level)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_values_are_two_classes() {
        let samples = [vec![1000; 30], vec![9000; 10]].concat();
        let level = level(&Field::new(8, samples).expect("five rows")).expect("two classes");
        assert_eq!(level.middle, 5000, "midway");
        assert!((level.share - 0.25).abs() < 1e-12 && (level.separation - 1.0).abs() < 1e-9, "{level:?}");
        assert_eq!(super::level(&Field::new(2, vec![7; 4]).expect("two rows")), None, "all alike");
    }
}
