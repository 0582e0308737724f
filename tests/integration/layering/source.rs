//! A source without what names things freely (comments, text literals), and the words that are left.

/// A word (`use`, `crate`, a name, a number), `::`, or any other single character, with its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Token<'a> {
    pub text: &'a str,
    pub line: usize,
}

impl Token<'_> {
    pub(crate) fn is_name(&self) -> bool {
        self.text.starts_with(|c: char| c.is_alphabetic() || c == '_')
    }
}

/// The source with spaces for comments, the contents of text literals, characters and lifetimes. Lines stay where they are.
pub(crate) fn code_of(source: &str) -> String {
    let letters: Vec<char> = source.chars().collect();
    let mut code = String::with_capacity(source.len());
    let mut i = 0;
    while i < letters.len() {
        let end = match letters[i] {
            '/' if letters.get(i + 1) == Some(&'/') => end_of_line(&letters, i),
            '/' if letters.get(i + 1) == Some(&'*') => end_of_block(&letters, i),
            '"' => end_of_text(&letters, i),
            '\'' => end_of_quote(&letters, i),
            'r' if !follows_a_word(&letters, i) => end_of_raw_text(&letters, i).unwrap_or(i),
            _ => i,
        };
        if end == i {
            code.push(letters[i]);
            i += 1;
        } else {
            code.extend(letters[i..end].iter().map(|&c| if c == '\n' { '\n' } else { ' ' }));
            i = end;
        }
    }
    code
}

/// Whether the letter at `i` belongs to a word that began before; `br"…"` begins a text, too.
fn follows_a_word(letters: &[char], i: usize) -> bool {
    let word = |i: usize| letters[i].is_alphanumeric() || letters[i] == '_';
    i > 0 && word(i - 1) && !(letters[i - 1] == 'b' && (i == 1 || !word(i - 2)))
}

fn end_of_line(letters: &[char], start: usize) -> usize {
    letters[start..].iter().position(|&c| c == '\n').map_or(letters.len(), |length| start + length)
}

/// Block comments nest.
fn end_of_block(letters: &[char], start: usize) -> usize {
    let (mut depth, mut i) = (0, start);
    while i < letters.len() {
        match (letters[i], letters.get(i + 1)) {
            ('/', Some('*')) => {
                depth += 1;
                i += 2;
            }
            ('*', Some('/')) => {
                depth -= 1;
                i += 2;
                if depth == 0 {
                    return i;
                }
            }
            _ => i += 1,
        }
    }
    letters.len()
}

fn end_of_text(letters: &[char], start: usize) -> usize {
    let mut i = start + 1;
    while i < letters.len() && letters[i] != '"' {
        i += if letters[i] == '\\' { 2 } else { 1 };
    }
    letters.len().min(i + 1)
}

/// `r"…"` and `r#"…"#`; `None` where the letter begins nothing of the kind.
fn end_of_raw_text(letters: &[char], start: usize) -> Option<usize> {
    let marks = letters[start + 1..].iter().take_while(|&&c| c == '#').count();
    let first = start + 1 + marks;
    if letters.get(first) != Some(&'"') {
        return None;
    }
    let ends = |i: usize| letters[i] == '"' && letters[i + 1..].iter().take_while(|&&c| c == '#').count() >= marks;
    let end = (first + 1..letters.len()).find(|&i| ends(i)).map_or(letters.len(), |i| i + 1 + marks);
    Some(end)
}

/// A character, or a lifetime or label.
fn end_of_quote(letters: &[char], start: usize) -> usize {
    match (letters.get(start + 1), letters.get(start + 2)) {
        (Some('\\'), _) => {
            let rest = &letters[letters.len().min(start + 3)..];
            rest.iter().position(|&c| c == '\'').map_or(letters.len(), |length| start + 4 + length)
        }
        (Some(_), Some('\'')) => start + 3,
        _ => {
            let name = letters[start + 1..].iter().take_while(|c| c.is_alphanumeric() || **c == '_').count();
            start + 1 + name
        }
    }
}

/// The words and signs of code that [`code_of`] has gone over.
pub(crate) fn tokens(code: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let (mut line, mut rest) = (1, code);
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let length = if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        let (text, after) = rest.split_at(length);
        if !first.is_whitespace() {
            found.push(Token { text, line });
        }
        line += usize::from(first == '\n');
        rest = after;
    }
    found
}

/// All sources below a folder, by their paths from `base` with slashes, in their order.
pub(crate) fn sources(folder: &std::path::Path, base: &std::path::Path, into: &mut Vec<(String, String)>) {
    let mut entries: Vec<_> =
        std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            sources(&path, base, into);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let name = path.strip_prefix(base).expect("below the base").to_string_lossy().replace('\\', "/");
            into.push((name, std::fs::read_to_string(&path).expect("a source")));
        }
    }
}
