//! Numbers as programs write them in text.

use lexical_parse_float::FromLexical;

/// A number in double precision; `nan` and `inf` as they are, in the spellings of the C libraries. The exponents of Fortran may start with `D`.
#[inline(never)]
pub(super) fn parse_number(word: &[u8]) -> Option<f64> {
    f64::from_lexical(word).ok().or_else(|| unusual(word))
}

/// What few files hold, and what most words are not.
#[cold]
#[inline(never)]
fn unusual(word: &[u8]) -> Option<f64> {
    let (negative, unsigned) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, word),
    };
    // `nan(ind)`, `-nan(0x1)`.
    if let Some(kind) = unsigned.strip_prefix(b"nan(").and_then(|kind| kind.strip_suffix(b")")) {
        return kind.iter().all(u8::is_ascii_alphanumeric).then_some(f64::NAN);
    }
    // Windows: `1.#QNAN`, `-1.#IND00`, `1.#INF`; `1.#J` and `1.#R` are these after rounding to two digits.
    if let Some(kind) = unsigned.strip_prefix(b"1.#") {
        let letters = kind.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        let (kind, digits) = kind.split_at(letters);
        if !digits.iter().all(u8::is_ascii_digit) {
            return None;
        }
        return match kind.to_ascii_uppercase().as_slice() {
            b"INF" if negative => Some(f64::NEG_INFINITY),
            b"INF" => Some(f64::INFINITY),
            b"QNAN" | b"SNAN" | b"IND" | b"NAN" | b"J" | b"R" => Some(f64::NAN),
            _ => None,
        };
    }
    if unsigned.eq_ignore_ascii_case(b"nanq") || unsigned.eq_ignore_ascii_case(b"nans") {
        return Some(f64::NAN);
    }
    let exponent = word.iter().position(|byte| matches!(byte, b'd' | b'D')).filter(|_| word.len() < 64)?;
    let mut number = word.to_vec();
    number[exponent] = b'e';
    f64::from_lexical(&number).ok()
}

/// A number that may have a comma where others have a point.
pub(super) fn parse_with_comma(word: &[u8]) -> Option<f64> {
    parse_number(word).or_else(|| {
        let comma = word.iter().position(|&byte| byte == b',').filter(|_| word.len() < 64)?;
        let mut number = word.to_vec();
        number[comma] = b'.';
        // A second comma or a point makes this no number.
        parse_number(&number)
    })
}

/// Whether a cell of a table says that its value is missing, as statistical programs and spreadsheets do.
pub(super) fn is_missing(cell: &[u8]) -> bool {
    const WORDS: [&[u8]; 11] = [b"", b"NA", b"N/A", b"null", b"none", b"nil", b"missing", b"-", b"--", b".", b"?"];
    cell.len() <= 8 && (WORDS.iter().any(|word| cell.eq_ignore_ascii_case(word)) || is_spreadsheet_error(cell))
}

/// Whether a cell starts as spreadsheets write a value that could not be computed, which is no comment.
pub(super) fn is_spreadsheet_error(cell: &[u8]) -> bool {
    const WORDS: [&[u8]; 7] = [b"#N/A", b"#DIV/0!", b"#VALUE!", b"#REF!", b"#NUM!", b"#NAME?", b"#NULL!"];
    WORDS.iter().any(|word| cell.starts_with(word))
}

/// A signed integer.
#[inline(never)]
pub(super) fn parse_integer(word: &[u8]) -> Option<i64> {
    core::str::from_utf8(word).ok()?.parse().ok()
}

/// A number of things.
#[inline(never)]
pub(super) fn parse_count(word: &[u8]) -> Option<u64> {
    core::str::from_utf8(word).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_exact_and_nothing_else_is_a_number() {
        for (text, value) in [
            ("0.1", 0.1),
            ("+1.", 1.0),
            ("-.5E+1", -5.0),
            ("5e-324", 5e-324),
            ("-INF", f64::NEG_INFINITY),
            ("1.#INF", f64::INFINITY),
            ("-1.#INF00", f64::NEG_INFINITY),
            ("1.0D+00", 1.0),
            ("-2.5d-3", -2.5e-3),
        ] {
            assert_eq!(parse_number(text.as_bytes()), Some(value), "{text}");
        }
        for text in ["nan", "-NaN", "nan(ind)", "-nan(0x1)", "1.#QNAN", "-1.#IND", "1.#qnan0", "1.#J", "NaNQ"] {
            assert!(parse_number(text.as_bytes()).is_some_and(f64::is_nan), "{text}");
        }
        for text in [
            "", "-", ".", "e5", "1,5", "0x10", "1e", "1_000", "1.#", "1.#X", "1.#INFx", "2.#INF", "nan(", "nan()x",
            "NA", "--1", "1d", "d1", "1dd1", "1e1d1", "\u{661}",
        ] {
            assert_eq!(parse_number(text.as_bytes()), None, "{text}");
        }
        assert_eq!((parse_count(b"-1"), parse_count(b"1.0"), parse_integer(b"-1")), (None, None, Some(-1)));
        assert_eq!(
            (parse_with_comma(b"1,5"), parse_with_comma(b"1,2,3"), parse_with_comma(b"1,2.3")),
            (Some(1.5), None, None)
        );
    }
}
