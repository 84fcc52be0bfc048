//! Units of measurement: their symbols and the grammar of compound units.
//!
//! ```text
//! unit     = spelling | ["1"] ["/"] factor { ["*" | "·" | "." | "-" | "/"] factor }
//! factor   = symbol [["^"] exponent]
//! symbol   = [prefix] unit symbol
//! exponent = a small integer, also in superscript
//! ```
//!
//! Factors side by side multiply; a `/` divides by the next factor only: `N/m s` is `(N/m)·s`. A `-` before
//! a letter multiplies, before a digit it belongs to an exponent. A spelling stands in the table as a whole:
//! the `lb` of `ft-lb` is a force, and what turns at `1450 1/min` makes 1450 revolutions a minute.

use super::{dimension::Dimension, spelling};
use std::{f64::consts::TAU, ops::Range};

/// A unit of measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    /// The unit in SI units.
    pub(super) scale: f64,
    /// What it measures.
    pub(super) dimension: Dimension,
}

/// A unit with a symbol of its own.
struct Named {
    /// Its spellings, the preferred one first. In compound ones every product is a `-`, and an exponent
    /// has no `^`, as [`plain`] makes them.
    symbols: &'static [&'static str],
    name: &'static str,
    unit: Unit,
    /// Whether the symbols take SI prefixes.
    metric: bool,
}

const fn metric(
    symbols: &'static [&'static str],
    name: &'static str,
    scale: f64,
    dimension: Dimension,
) -> Named {
    Named {
        symbols,
        name,
        unit: Unit { scale, dimension },
        metric: true,
    }
}

const fn other(
    symbols: &'static [&'static str],
    name: &'static str,
    scale: f64,
    dimension: Dimension,
) -> Named {
    Named {
        metric: false,
        ..metric(symbols, name, scale, dimension)
    }
}

/// International inch, m (exact).
const INCH: f64 = 0.0254;
/// International avoirdupois pound, kg (exact).
const POUND: f64 = 0.453_592_37;
/// Standard gravity, m/s² (exact).
const GRAVITY: f64 = 9.806_65;

const UNITS: [Named; 38] = [
    metric(&["m"], "metre", 1.0, Dimension::LENGTH),
    other(&["in", "inch"], "inch", INCH, Dimension::LENGTH),
    other(&["ft"], "foot", 12.0 * INCH, Dimension::LENGTH),
    metric(&["g"], "gram", 1e-3, Dimension::MASS),
    other(&["lb", "lbs"], "pound", POUND, Dimension::MASS),
    other(&["lbm"], "pound mass", POUND, Dimension::MASS),
    other(&["oz"], "ounce", POUND / 16.0, Dimension::MASS),
    metric(&["s", "sec"], "second", 1.0, Dimension::TIME),
    other(&["min"], "minute", 60.0, Dimension::TIME),
    other(&["h", "hr"], "hour", 3600.0, Dimension::TIME),
    metric(&["rad"], "radian", 1.0, Dimension::ANGLE),
    other(&["deg", "°"], "degree", TAU / 360.0, Dimension::ANGLE),
    other(&["rev", "r", "U"], "revolution", TAU, Dimension::ANGLE),
    // ISO 80000-3 gives r/min and 1/min for the rotational frequency: no other angle than a revolution is
    // meant. 1/s is not here, because it may be rad/s.
    other(
        &["rpm", "RPM", "1/min", "/min", "min-1"],
        "rev/min",
        TAU / 60.0,
        Dimension::ANGULAR_SPEED,
    ),
    // A frequency of rotation: what turns at 1 Hz turns by 2π rad in a second.
    metric(&["Hz"], "hertz", TAU, Dimension::ANGULAR_SPEED),
    metric(&["N"], "newton", 1.0, Dimension::FORCE),
    other(&["kgf", "kp"], "kilopond", GRAVITY, Dimension::FORCE),
    other(&["lbf"], "pound force", POUND * GRAVITY, Dimension::FORCE),
    metric(&["Pa"], "pascal", 1.0, Dimension::FORCE_PER_AREA),
    metric(&["bar"], "bar", 1e5, Dimension::FORCE_PER_AREA),
    other(
        &["psi"],
        "pound per square inch",
        POUND * GRAVITY / (INCH * INCH),
        Dimension::FORCE_PER_AREA,
    ),
    metric(&["J"], "joule", 1.0, Dimension::TORQUE),
    // The product written without a sign, as torques often are.
    metric(&["Nm"], "newton metre", 1.0, Dimension::TORQUE),
    other(&["Ncm"], "newton centimetre", 1e-2, Dimension::TORQUE),
    other(&["Nmm"], "newton millimetre", 1e-3, Dimension::TORQUE),
    // In these the pound and the ounce are forces.
    other(
        &["ft-lb", "lb-ft", "ft-lbs"],
        "foot pound",
        12.0 * INCH * POUND * GRAVITY,
        Dimension::TORQUE,
    ),
    other(
        &["in-lb", "lb-in", "in-lbs"],
        "inch pound",
        INCH * POUND * GRAVITY,
        Dimension::TORQUE,
    ),
    other(
        &["oz-in", "in-oz"],
        "inch ounce",
        INCH * POUND * GRAVITY / 16.0,
        Dimension::TORQUE,
    ),
    metric(&["W"], "watt", 1.0, Dimension::POWER),
    // Mechanical horsepower: 550 ft·lbf/s.
    other(
        &["hp"],
        "horsepower",
        550.0 * 12.0 * INCH * POUND * GRAVITY,
        Dimension::POWER,
    ),
    other(
        &["mph"],
        "mile/h",
        5280.0 * 12.0 * INCH / 3600.0,
        Dimension::VELOCITY,
    ),
    other(
        &["fpm"],
        "foot/min",
        12.0 * INCH / 60.0,
        Dimension::VELOCITY,
    ),
    other(&["mil"], "mil", 1e-3 * INCH, Dimension::LENGTH),
    other(&["t"], "tonne", 1e3, Dimension::MASS),
    other(
        &["ozf"],
        "ounce force",
        POUND * GRAVITY / 16.0,
        Dimension::FORCE,
    ),
    other(
        &["ksi"],
        "kilopound per square inch",
        1e3 * POUND * GRAVITY / (INCH * INCH),
        Dimension::FORCE_PER_AREA,
    ),
    other(&["%"], "percent", 1e-2, Dimension::NUMBER),
    other(
        &["kip"],
        "kilopound force",
        1e3 * POUND * GRAVITY,
        Dimension::FORCE,
    ),
];

/// SI prefixes: symbol, name, factor. Micro is written in three ways.
const PREFIXES: [(&str, &str, f64); 12] = [
    ("G", "giga", 1e9),
    ("M", "mega", 1e6),
    ("k", "kilo", 1e3),
    ("h", "hecto", 1e2),
    ("da", "deca", 1e1),
    ("d", "deci", 1e-1),
    ("c", "centi", 1e-2),
    ("m", "milli", 1e-3),
    ("u", "micro", 1e-6),
    ("\u{b5}", "micro", 1e-6),
    ("\u{3bc}", "micro", 1e-6),
    ("n", "nano", 1e-9),
];

/// Largest exponent of a factor: far above any physical one, far below any overflow.
const MAX_EXPONENT: u32 = 9;

/// Reads a unit; the error is the part of `text` that is none.
pub(super) fn parse(text: &str) -> Result<Unit, Range<usize>> {
    let whole = plain(text);
    if let Some(named) = UNITS.iter().find(|named| named.symbols.contains(&&*whole)) {
        return Ok(named.unit);
    }
    let mut unit = Unit {
        scale: 1.0,
        dimension: Dimension::NUMBER,
    };
    // The 1 of "1/m" is an empty numerator, not a factor.
    let mut position = match text.strip_prefix('1') {
        Some(rest) if rest.trim_start().starts_with('/') => 1,
        _ => 0,
    };
    // An operator that waits for its right factor.
    let mut operator: Option<(char, Range<usize>)> = None;
    while let Some(first) = text[position..].chars().next() {
        let rest = &text[position..];
        let joins = position > 0 && is_hyphen(rest);
        let is_factor = !joins && !is_separator(first);
        let length = match is_factor {
            true => factor_length(rest),
            false => first.len_utf8(),
        };
        let range = position..position + length;
        position = range.end;
        if first.is_whitespace() {
            continue;
        } else if is_factor {
            let (factor, exponent) = factor(&text[range.clone()]).ok_or(range)?;
            let exponent = match operator.take() {
                Some(('/', _)) => -exponent,
                _ => exponent,
            };
            unit.scale *= factor.scale.powi(exponent);
            unit.dimension = unit.dimension.times(factor.dimension, exponent);
        } else if operator.replace((first, range.clone())).is_some() {
            return Err(range);
        }
    }
    match operator {
        Some((_, range)) => Err(range),
        None => Ok(unit),
    }
}

/// The right spelling nearest to a factor that is no unit, with its exponent.
pub(super) fn nearest(factor: &str) -> Option<String> {
    let (symbol, exponent) = split_exponent(factor);
    let plain = UNITS.iter().flat_map(|named| {
        let symbol = named.symbols[0].to_owned();
        [
            (symbol.clone(), symbol.clone()),
            (named.name.to_owned(), symbol),
        ]
    });
    let metric = UNITS.iter().filter(|named| named.metric);
    let prefixed = metric.flat_map(|named| {
        PREFIXES.iter().flat_map(|(prefix, name, _)| {
            let symbol = format!("{prefix}{}", named.symbols[0]);
            [
                (symbol.clone(), symbol.clone()),
                (format!("{name}{}", named.name), symbol),
            ]
        })
    });
    spelling::nearest(symbol, plain.chain(prefixed)).map(|symbol| symbol + exponent)
}

fn is_separator(c: char) -> bool {
    c.is_whitespace() || matches!(c, '*' | '·' | '⋅' | '.' | '/')
}

/// Whether a text begins with a `-` that multiplies: one before a letter.
fn is_hyphen(text: &str) -> bool {
    let behind = text.strip_prefix('-');
    behind.is_some_and(|behind| behind.starts_with(char::is_alphabetic))
}

/// Length of the factor that a text begins with.
fn factor_length(text: &str) -> usize {
    let mut places = text.char_indices();
    let end = places.find(|&(i, c)| i > 0 && (is_separator(c) || is_hyphen(&text[i..])));
    end.map_or(text.len(), |(i, _)| i)
}

/// A text as the table spells it: `ft·lb` and `ft lb` as `ft-lb`, `min⁻¹` and `min^-1` as `min-1`.
fn plain(text: &str) -> String {
    let text: String = text.chars().map(plain_digit).collect();
    let factors = text.split(|c| is_separator(c) && c != '/');
    let factors: Vec<_> = factors.filter(|factor| !factor.is_empty()).collect();
    let text = factors.join("-").replace("^-", "-");
    text.replace("-/", "/").replace("/-", "/")
}

/// Reads one factor: a unit and the exponent it is raised to.
fn factor(text: &str) -> Option<(Unit, i32)> {
    let (symbol, exponent) = split_exponent(text);
    let unit = lookup(symbol)?;
    if exponent.is_empty() {
        return Some((unit, 1));
    }
    let exponent: String = exponent.chars().map(plain_digit).collect();
    let exponent: i32 = exponent
        .strip_prefix('^')
        .unwrap_or(&exponent)
        .parse()
        .ok()?;
    (exponent != 0 && exponent.unsigned_abs() <= MAX_EXPONENT).then_some((unit, exponent))
}

fn split_exponent(factor: &str) -> (&str, &str) {
    let is_exponent = |c| matches!(plain_digit(c), '^' | '+' | '-' | '0'..='9');
    factor.split_at(factor.find(is_exponent).unwrap_or(factor.len()))
}

/// The ASCII form of superscript digits and signs; other characters as they are.
fn plain_digit(c: char) -> char {
    match c {
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        '⁻' | '−' => '-',
        _ => c,
    }
}

/// A symbol as it stands in the table or, if it stands there not, with a prefix split off: `min` is
/// a minute and no milli-inch.
fn lookup(symbol: &str) -> Option<Unit> {
    let find = |symbol: &str| UNITS.iter().find(|named| named.symbols.contains(&symbol));
    if let Some(named) = find(symbol) {
        return Some(named.unit);
    }
    PREFIXES.iter().find_map(|(prefix, _, factor)| {
        let named = find(symbol.strip_prefix(prefix)?).filter(|named| named.metric)?;
        Some(Unit {
            scale: factor * named.unit.scale,
            ..named.unit
        })
    })
}

#[cfg(test)]
mod tests;
