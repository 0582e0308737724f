//! Names of fields and columns: unique, and spelt in the letters that a format has.

use std::collections::BTreeMap;

/// Names given so far, each with the number that its next namesake tries first. In order, because a table may have very many.
#[derive(Debug, Default)]
pub(super) struct Names(BTreeMap<String, u64>);

impl Names {
    /// Whether a name was there before.
    pub(super) fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// `name`, or `name_2`, `name_3`, … when it was there before.
    pub(super) fn unique(&mut self, name: &str) -> String {
        let Some(&last) = self.0.get(name) else {
            self.0.insert(name.to_owned(), 1);
            return name.to_owned();
        };
        let mut number = last;
        // More than one round only where `name_2` is itself a name of the file.
        let unique = loop {
            number += 1;
            let candidate = format!("{name}_{number}");
            if !self.0.contains_key(&candidate) {
                break candidate;
            }
        };
        self.0.insert(name.to_owned(), number);
        self.0.insert(unique.clone(), 1);
        unique
    }
}

/// A name in the letters that every program reads: others become `%20` and the like.
pub(super) fn encode_name(name: &str) -> String {
    let mut encoded = String::with_capacity(name.len());
    for byte in name.bytes() {
        if matches!(byte, b'!'..=b'~') && !matches!(byte, b'%' | b'"') {
            encoded.push(char::from(byte));
        } else {
            encoded.push_str(&format!("%{byte:02X}"));
        }
    }
    encoded
}

/// Undoes `%20` and the like.
pub(super) fn decode_name(name: &[u8]) -> String {
    let mut decoded = Vec::with_capacity(name.len());
    let mut rest = name;
    while let [first, after @ ..] = rest {
        let code = match after {
            [high, low, ..] if *first == b'%' => hexadecimal(*high).zip(hexadecimal(*low)),
            _ => None,
        };
        if let Some((high, low)) = code {
            decoded.push(high << 4 | low);
            rest = &after[2..];
        } else {
            decoded.push(*first);
            rest = after;
        }
    }
    String::from_utf8_lossy(&decoded).into_owned()
}

fn hexadecimal(digit: u8) -> Option<u8> {
    char::from(digit).to_digit(16).and_then(|digit| u8::try_from(digit).ok())
}
