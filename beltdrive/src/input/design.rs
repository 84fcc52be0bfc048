//! What a design may change, and what it makes small.

use super::{
    Diagnostic, DriveFile, FileKey, check,
    diagnostic::Finding,
    document::{Content, DesignEntry, Entry},
    schema::{self, CHOOSE, FREE, Kind, MINIMISE},
    spelling,
    values::Values,
};
use crate::quantity::Measure;
use crate::sections::Family;

/// Most combinations of chosen values: each is a search of its own.
const COMBINATIONS: usize = 1000;

/// What is asked of a design: the table `[design]` of a drive file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DesignQuestion {
    /// What is to be as small as possible.
    pub objective: DesignObjective,
    /// The numbers that may vary within bounds.
    pub free: Vec<FreeKey>,
    /// The keys that take one of several values each.
    pub choices: Vec<Choice>,
}

/// What a design makes as small as possible.
#[derive(Clone, Debug, PartialEq)]
pub enum DesignObjective {
    /// The largest hub load of all pulleys and load cases, running or at rest, N.
    HubLoad,
    /// Power in less power out with the given losses, over the time, or the mean of all load cases where they have no
    /// shares of it, W.
    Loss,
    /// The largest speed loss of a pulley with a torque in any load case.
    SpeedLoss,
    /// Mass of the belt, kg.
    BeltMass,
    /// Width of the belt, m: `belt.width`, or what a section says of one V-belt or rib, times their number.
    Width,
    /// One of the free numbers.
    Key(FileKey),
}

/// A number of the drive file that may vary within bounds.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FreeKey {
    /// The number.
    pub key: FileKey,
    /// Its smallest and its largest value, SI.
    pub bounds: [f64; 2],
}

/// A key of the drive file that takes one of several values.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Choice {
    /// Its dotted path.
    pub path: String,
    /// The values, in the order of the file.
    pub values: Vec<ChoiceValue>,
}

/// A value that a key may take.
#[derive(Clone, Debug, PartialEq)]
pub enum ChoiceValue {
    /// A word, such as the name of a section.
    Word(String),
    /// A number, SI.
    Number(Measure, f64),
}

impl DesignObjective {
    /// The words of `design.minimise` for what follows from states; a free number goes by its path.
    pub(crate) const WORDS: [(&str, Self); 5] = [
        ("hub_load", Self::HubLoad),
        ("loss", Self::Loss),
        ("speed_loss", Self::SpeedLoss),
        ("belt_mass", Self::BeltMass),
        ("width", Self::Width),
    ];
}

impl DesignQuestion {
    /// How many combinations of the chosen values there are; 1 without choices.
    #[must_use]
    pub fn combinations(&self) -> usize {
        let counts = self.choices.iter().map(|choice| choice.values.len());
        counts.fold(1, usize::saturating_mul)
    }
}

impl DriveFile {
    /// What the file asks of a design.
    ///
    /// # Errors
    /// There is no table `[design]` or nothing may change, a key is none of the file or stands twice, bounds are no
    /// range, a value does not fit its key, or there are more than 1000 combinations.
    pub fn design(&self) -> Result<DesignQuestion, Diagnostic> {
        self.asked()
            .map_err(|finding| Diagnostic::new(finding, &self.source))
    }

    fn asked(&self) -> Result<DesignQuestion, Finding> {
        let values = Values::check(&self.document, &self.source)?;
        values.required_text(MINIMISE)?;
        let mut seen: Vec<&str> = Vec::new();
        let (mut free, mut choices) = (Vec::new(), Vec::new());
        for designed in &self.document.designed {
            if seen.contains(&&*designed.path) {
                let message = format!("`{}` stands twice in [design]", designed.path);
                return Err(Finding::new(designed.entry.key.clone(), message)
                    .expected("bounds in [design.free], or values in [design.choose]"));
            }
            seen.push(&designed.path);
            match designed.table == FREE {
                true => free.push(self.free(designed)?),
                false => choices.push(self.choice(designed)?),
            }
        }
        if seen.is_empty() {
            let message = "nothing says what the design may change";
            return Err(Finding::new(values.key_place("design"), message).expected(
                "[design.free] with load.setup_tension = [\"200 N\", \"2 kN\"], or values in [design.choose]",
            ));
        }
        let question = DesignQuestion {
            objective: self.objective(&values, &free)?,
            free,
            choices,
        };
        match question.combinations() {
            count if count > COMBINATIONS => {
                let message = format!("the values of [design.choose] make {count} combinations");
                Err(Finding::new(values.key_place(CHOOSE), message)
                    .expected(format!("at most {COMBINATIONS}")))
            }
            _ => Ok(question),
        }
    }

    /// What is to be made small.
    fn objective(&self, values: &Values<'_>, free: &[FreeKey]) -> Result<DesignObjective, Finding> {
        let word = values.required_text(MINIMISE)?;
        let known = { DesignObjective::WORDS.into_iter() }
            .find_map(|(name, objective)| (name == word).then_some(objective))
            .or_else(|| {
                let mut free = free.iter();
                let free = free.find(|free| free.key.path() == word)?;
                Some(DesignObjective::Key(free.key.clone()))
            });
        let words = DesignObjective::WORDS.map(|(word, _)| word);
        let names = || {
            let free = free.iter().map(|free| free.key.path());
            words.into_iter().chain(free)
        };
        let expected = || {
            let names = check::one_of(&words);
            match free.is_empty() {
                true => names,
                false => names + ", or a key of [design.free]",
            }
        };
        let Some(objective) = known else {
            let message = format!("`{word}` is nothing that a design makes small");
            return Err(Finding::new(values.place(MINIMISE), message)
                .expected(expected())
                .did_you_mean(spelling::nearest_key(word, names)));
        };
        if objective == DesignObjective::Width && self.belt_width().is_none() {
            let message = "the drive file says nothing of the width of its belt";
            return Err(Finding::new(values.place(MINIMISE), message)
                .expected("`belt.section`, or `belt.width` of a flat belt"));
        }
        Ok(objective)
    }

    /// A number that may vary within bounds.
    fn free(&self, designed: &DesignEntry) -> Result<FreeKey, Finding> {
        let DesignEntry { path, entry, .. } = designed;
        let known = self.keys();
        let known: Vec<_> = known
            .into_iter()
            .filter(|key| self.is_given(key.path()))
            .collect();
        let paths = || known.iter().map(FileKey::path);
        let Some(key) = known.iter().find(|key| key.path() == path) else {
            let message = match schema::rule(path) {
                Some(rule) if rule.is_whole() && self.is_given(path) => {
                    let message = format!("`{path}` is a whole number, which has no bounds");
                    return Err(Finding::new(entry.key.clone(), message)
                        .expected(format!("[design.choose] with {path} = [1, 2, 3]")));
                }
                Some(_) if schema::is_of_service(path) => {
                    format!("`{path}` does not change the steady state")
                }
                Some(_) => format!("the drive file gives no number `{path}`"),
                None => format!("unknown key `{path}`"),
            };
            return Err(Finding::new(entry.key.clone(), message)
                .expected(check::one_of(&paths().collect::<Vec<_>>()))
                .did_you_mean(spelling::nearest_key(path, paths)));
        };
        let quantity = |entry: &Entry| check::quantity(path, entry, &self.source);
        let rule = schema::rule(path).expect("a number of the file");
        let example = || {
            format!(
                "the smallest and the largest value, each a quantity such as {}",
                rule.example
            )
        };
        let Content::List(ends) = &entry.content else {
            return Err(check::wrong_type(path, "an array of bounds", entry).expected(example()));
        };
        let [low, high] = &ends[..] else {
            let message = format!("`{path}` must have two bounds, got {}", ends.len());
            return Err(Finding::new(entry.place.clone(), message).expected(example()));
        };
        let bounds = [quantity(low)?, quantity(high)?];
        if bounds[0] >= bounds[1] {
            let what = match bounds[0] == bounds[1] {
                true => "the same",
                false => "in reverse order",
            };
            return Err(Finding::new(
                entry.place.clone(),
                format!("the bounds of `{path}` are {what}"),
            )
            .expected("first the smaller value, then the larger one"));
        }
        Ok(FreeKey {
            key: key.clone(),
            bounds,
        })
    }

    /// A key that takes one of several values.
    fn choice(&self, designed: &DesignEntry) -> Result<Choice, Finding> {
        let DesignEntry { path, entry, .. } = designed;
        let can_vary = |path: &str| {
            let rule = schema::rule(path);
            let is_of_drive =
                |kind: &Kind| !matches!(kind, Kind::Keys | Kind::Spread | Kind::Refused { .. });
            path != "title"
                && !schema::is_of_service(path)
                && rule.is_some_and(|rule| is_of_drive(&rule.kind))
                && self.is_given(path)
        };
        let paths = || {
            let paths = self.document.entries.keys().map(String::as_str);
            paths.filter(|path| can_vary(path) && !path.ends_with(".name"))
        };
        let rule = schema::rule(path).filter(|_| paths().any(|known| known == path));
        let Some(rule) = rule else {
            let message = match schema::rule(path) {
                Some(_) if schema::is_of_service(path) => {
                    format!("`{path}` does not change the steady state")
                }
                Some(_) => {
                    format!("the drive file gives no `{path}` to put another value in its place")
                }
                None => format!("unknown key `{path}`"),
            };
            return Err(Finding::new(entry.key.clone(), message)
                .expected(check::one_of(&paths().collect::<Vec<_>>()))
                .did_you_mean(spelling::nearest_key(path, paths)));
        };
        let example = || format!("an array of values, e.g. [{}]", rule.example);
        let Content::List(elements) = &entry.content else {
            return Err(check::wrong_type(path, "an array of values", entry).expected(example()));
        };
        let mut values = Vec::new();
        for element in elements {
            let value = match rule.kind {
                Kind::Quantity { dimension, range } => {
                    let value = check::number(path, rule, dimension, range, element, &self.source)?;
                    let measure = dimension.measure().unwrap_or(Measure::Number);
                    ChoiceValue::Number(measure, value)
                }
                Kind::Word { what, words } => {
                    ChoiceValue::Word(check::word(path, rule, what, words, element)?.to_owned())
                }
                _ => ChoiceValue::Word(check::text(path, rule, element)?.to_owned()),
            };
            if values.contains(&value) {
                let message = format!("a value of `{path}` stands twice");
                return Err(Finding::new(element.place.clone(), message));
            }
            values.push(value);
        }
        match values.is_empty() {
            true => {
                let message = format!("`{path}` has no value to choose");
                Err(Finding::new(entry.place.clone(), message).expected(example()))
            }
            false => Ok(Choice {
                path: path.clone(),
                values,
            }),
        }
    }

    /// Whether the file or an override gives an entry, and no belt section.
    fn is_given(&self, path: &str) -> bool {
        let filled = self.filled_in.as_ref();
        let is_filled =
            filled.is_some_and(|filled| filled.entries.iter().any(|entry| entry.path == path));
        self.document.entries.contains_key(path) && !is_filled
    }
}

impl DriveFile {
    /// The file with values of free numbers, SI.
    pub(crate) fn designed(&self, free: &[FreeKey], values: &[f64]) -> Self {
        let contents = free.iter().zip(values);
        let contents =
            contents.map(|(free, value)| (free.key.path().to_owned(), Content::Number(*value)));
        self.restated(contents)
    }

    /// The file with one of the values of each choice, by its index.
    pub(crate) fn chosen(&self, choices: &[Choice], chosen: &[usize]) -> Self {
        let contents = choices.iter().zip(chosen);
        self.restated(contents.map(|(choice, &index)| {
            let content = match &choice.values[index] {
                ChoiceValue::Word(word) => Content::Text(word.clone()),
                ChoiceValue::Number(_, value) => Content::Number(*value),
            };
            (choice.path.clone(), content)
        }))
    }

    /// The width of the belt, m, if the file or its belt section says it: that of all V-belts together.
    pub(crate) fn belt_width(&self) -> Option<f64> {
        let values = Values::check(&self.document, &self.source).ok()?;
        values.number("belt.width").or_else(|| {
            let section = self.filled_in.as_ref()?.section;
            let of_one = match section.family {
                Family::PolyV => section.datum_width?,
                _ => section.top_width?,
            };
            Some(of_one.value * values.number("belt.ribs").unwrap_or(1.0))
        })
    }
}
