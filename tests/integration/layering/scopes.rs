//! What a file declares and names: the modules in it, their items, their `use` trees with the groups undone, and every path.

use std::collections::{BTreeMap, BTreeSet};

use super::source::{Token, code_of, tokens};

/// One name that a `use` brings in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Use {
    /// As it is written, groups undone: `super`, `order`, `VertexOrder`.
    pub path: Vec<String>,
    /// What it is called here; `*` brings in all, `_` nothing that has a name.
    pub alias: String,
    /// Whether it can be used from elsewhere, as with `pub` or `pub(crate)`.
    pub is_reexport: bool,
    pub line: usize,
}

/// A path in code, outside of `use`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Path {
    pub path: Vec<String>,
    pub line: usize,
}

/// A file, or a module that is written out in one.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scope {
    /// Below the file's own module: empty for the file itself.
    pub module: Vec<String>,
    pub items: BTreeSet<String>,
    pub uses: Vec<Use>,
    pub paths: Vec<Path>,
    /// How often each word stands outside of `use`.
    pub words: BTreeMap<String, usize>,
}

const ITEMS: [&str; 8] = ["struct", "enum", "union", "trait", "type", "fn", "const", "static"];

/// The scopes of a file; its own is the first.
pub(crate) fn scopes_of(source: &str) -> Vec<Scope> {
    let code = code_of(source);
    let tokens = tokens(&code);
    let mut reader = Reader { tokens: &tokens, scopes: vec![Scope::default()], open: vec![(0, 0)], depth: 0 };
    let mut at = 0;
    while at < tokens.len() {
        at = reader.step(at);
    }
    reader.scopes
}

struct Reader<'a> {
    tokens: &'a [Token<'a>],
    scopes: Vec<Scope>,
    /// The scopes that the token is in, innermost last, with the depth of braces in which their items stand.
    open: Vec<(usize, usize)>,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn text(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |token| token.text)
    }

    fn is_name(&self, at: usize) -> bool {
        self.tokens.get(at).is_some_and(Token::is_name)
    }

    fn scope(&mut self) -> &mut Scope {
        let (scope, _) = self.open[self.open.len() - 1];
        &mut self.scopes[scope]
    }

    /// Reads what begins at a token, and says where the next begins.
    fn step(&mut self, at: usize) -> usize {
        let is_module_level = self.open.last().is_some_and(|&(_, depth)| depth == self.depth);
        match self.text(at) {
            "{" => self.depth += 1,
            "}" => {
                self.depth = self.depth.saturating_sub(1);
                if self.open.len() > 1 && self.open.last().is_some_and(|&(_, depth)| depth > self.depth) {
                    self.open.pop();
                }
            }
            // Who may see something is no use of it.
            "pub" if self.text(at + 1) == "(" => return self.after(at + 2, ")"),
            // `impl Trait + use<'a>` captures.
            "use" if self.text(at + 1) != "<" => return self.read_use(at),
            "mod" if self.is_name(at + 1) && self.text(at + 2) == "{" => return self.enter(at),
            "mod" if self.text(at + 2) == ";" => return at + 3,
            "macro_rules" if is_module_level => {
                let name = self.text(at + 2).to_owned();
                self.scope().items.insert(name);
            }
            word if self.is_name(at) => {
                if is_module_level && ITEMS.contains(&word) && self.is_name(at + 1) {
                    let name = self.text(at + 1).to_owned();
                    self.scope().items.insert(name);
                }
                return self.read_path(at);
            }
            _ => {}
        }
        at + 1
    }

    /// The place after the next such token.
    fn after(&self, mut at: usize, wanted: &str) -> usize {
        while at < self.tokens.len() && self.text(at) != wanted {
            at += 1;
        }
        at + 1
    }

    fn enter(&mut self, at: usize) -> usize {
        let mut module = self.scope().module.clone();
        module.push(self.text(at + 1).to_owned());
        self.depth += 1;
        self.open.push((self.scopes.len(), self.depth));
        self.scopes.push(Scope { module, ..Scope::default() });
        at + 3
    }

    /// A name, or names with `::` between them.
    fn read_path(&mut self, at: usize) -> usize {
        let mut path = vec![self.text(at).to_owned()];
        let mut next = at + 1;
        while self.text(next) == "::" && self.is_name(next + 1) {
            path.push(self.text(next + 1).to_owned());
            next += 2;
        }
        for word in &path {
            *self.scope().words.entry(word.clone()).or_default() += 1;
        }
        // What follows `<T as Trait>::` or a dot is no path from here, nor is `$name::` of a macro.
        let before = if at > 0 { self.text(at - 1) } else { "" };
        let starts = before != "::" && before != "." && (before != "$" || path[0] == "crate");
        if starts && path.len() > 1 {
            let line = self.tokens[at].line;
            self.scope().paths.push(Path { path, line });
        }
        next
    }

    fn read_use(&mut self, at: usize) -> usize {
        let (is_reexport, start) = self.visibility(at);
        let is_for_documentation = ["#", "[", "cfg", "(", "doc", ")", "]"]
            .iter()
            .rev()
            .enumerate()
            .all(|(back, text)| start > back && self.text(start - 1 - back) == *text);
        let mut leaves = Vec::new();
        let end = self.read_tree(at + 1, &[], &mut leaves);
        if !is_for_documentation {
            self.scope().uses.extend(leaves.into_iter().map(|leaf| Use { is_reexport, ..leaf }));
        }
        self.after(end, ";")
    }

    /// Whether `pub`, `pub(…)` stands before a token, and where the declaration begins.
    fn visibility(&self, at: usize) -> (bool, usize) {
        let before = |at: usize| if at > 0 { self.text(at - 1) } else { "" };
        if before(at) == "pub" {
            return (true, at - 1);
        }
        if before(at) != ")" {
            return (false, at);
        }
        let mut open = at - 1;
        while open > 0 && self.text(open) != "(" {
            open -= 1;
        }
        if before(open) == "pub" { (self.text(open + 1) != "self", open - 1) } else { (false, at) }
    }

    /// One tree of a `use`: a path that ends in a name, a star or a group of trees.
    fn read_tree(&self, mut at: usize, prefix: &[String], leaves: &mut Vec<Use>) -> usize {
        let mut path = prefix.to_vec();
        let line = self.tokens.get(at).map_or(0, |token| token.line);
        loop {
            match self.text(at) {
                "::" => at += 1,
                "{" => {
                    at += 1;
                    while self.text(at) != "}" && at < self.tokens.len() {
                        at = self.read_tree(at, &path, leaves);
                        at += usize::from(self.text(at) == ",");
                    }
                    return at + 1;
                }
                "*" => {
                    leaves.push(Use { path, alias: "*".to_owned(), is_reexport: false, line });
                    return at + 1;
                }
                word if self.is_name(at) => {
                    path.push(word.to_owned());
                    at += 1;
                    if self.text(at) == "::" {
                        continue;
                    }
                    if path.len() > 1 && word == "self" {
                        path.pop();
                    }
                    let mut alias = path[path.len() - 1].clone();
                    if self.text(at) == "as" {
                        alias = self.text(at + 1).to_owned();
                        at += 2;
                    }
                    leaves.push(Use { path, alias, is_reexport: false, line });
                    return at;
                }
                _ => return at,
            }
        }
    }
}
