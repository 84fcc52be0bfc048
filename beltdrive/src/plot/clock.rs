//! Figures that move: attributes of their elements over the time of playing, in the language of SVG, without a script. A
//! viewer that does not move anything shows the first frame.

/// The time of playing, after which it begins again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clock {
    /// Time that all frames take, s. They are evenly spaced, and the last one stands as long as one leads to the next.
    pub(super) duration: f64,
}

impl Clock {
    /// An attribute that goes from its value in a frame straight to that in the next one; nothing where it stays.
    pub(super) fn moves(&self, attribute: &str, values: &[String]) -> String {
        self.straight("animate", &format!("attributeName=\"{attribute}\""), values)
    }

    /// A transformation of a kind that goes straight from its values in a frame to those in the next one.
    pub(super) fn transforms(&self, kind: &str, values: &[String]) -> String {
        let attributes = format!("attributeName=\"transform\" type=\"{kind}\"");
        self.straight("animateTransform", &attributes, values)
    }

    /// An attribute that keeps its value up to the next frame; nothing where it stays.
    pub(super) fn jumps(&self, attribute: &str, values: &[String]) -> String {
        let changes = (0..values.len()).filter(|&at| at == 0 || values[at] != values[at - 1]);
        let changes: Vec<_> = changes.collect();
        if changes.len() < 2 {
            return String::new();
        }
        let times = changes.iter().map(|&at| at as f64 / values.len() as f64);
        // A thousandth of a frame, of the most there are, is not seen.
        let times = times.map(|time| format!("{}", (1e5 * time).round() / 1e5));
        let values = changes.iter().map(|&at| values[at].as_str());
        format!(
            "<animate attributeName=\"{attribute}\" calcMode=\"discrete\" keyTimes=\"{}\" values=\"{}\" {}/>",
            times.collect::<Vec<_>>().join(";"),
            values.collect::<Vec<_>>().join(";"),
            self.repeated()
        )
    }

    fn straight(&self, element: &str, attributes: &str, values: &[String]) -> String {
        let Some(last) = values.last() else {
            return String::new();
        };
        if values.iter().all(|value| value == last) {
            return String::new();
        }
        let values = values.join(";");
        let repeated = self.repeated();
        format!("<{element} {attributes} values=\"{values};{last}\" {repeated}/>")
    }

    fn repeated(&self) -> String {
        format!(
            "dur=\"{}s\" repeatCount=\"indefinite\"",
            shown(self.duration)
        )
    }
}

/// A number to a tenth.
pub(super) fn shown(number: f64) -> String {
    format!("{}", (10.0 * number).round() / 10.0 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLOCK: Clock = Clock { duration: 2.0 };

    fn texts(values: &[&str]) -> Vec<String> {
        values.iter().map(|&value| value.to_owned()).collect()
    }

    #[test]
    fn straight_and_stepwise_changes_keep_time_with_each_other() {
        // Frame 2 of 4 begins in the middle of both.
        assert_eq!(
            CLOCK.moves("stroke", &texts(&["a", "a", "b", "c"])),
            "<animate attributeName=\"stroke\" values=\"a;a;b;c;c\" dur=\"2s\" repeatCount=\"indefinite\"/>"
        );
        assert_eq!(
            CLOCK.jumps("d", &texts(&["a", "a", "b", "b"])),
            "<animate attributeName=\"d\" calcMode=\"discrete\" keyTimes=\"0;0.5\" values=\"a;b\" dur=\"2s\" \
             repeatCount=\"indefinite\"/>"
        );
        assert_eq!(
            CLOCK.transforms("rotate", &texts(&["0", "-30", "-60", "-90"])),
            "<animateTransform attributeName=\"transform\" type=\"rotate\" values=\"0;-30;-60;-90;-90\" dur=\"2s\" \
             repeatCount=\"indefinite\"/>"
        );
    }

    #[test]
    fn what_stays_does_not_move() {
        for values in [&[][..], &["a"], &["a"; 4]] {
            assert_eq!(CLOCK.moves("d", &texts(values)), "");
            assert_eq!(CLOCK.jumps("d", &texts(values)), "");
        }
        assert_eq!(CLOCK.transforms("rotate", &texts(&["0"; 4])), "");
    }
}
