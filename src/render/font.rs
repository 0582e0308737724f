//! The letters of pictures: a sans serif of single strokes, drawn for them, so that no font file has to be
//! downloaded and read.
//!
//! Capitals are 70 units high, small letters 50, descenders reach down to −20; y is 0 on the baseline and points up. Paths are
//! the middles of strokes, which are about 9 units wide. Digits are equally wide.
//!
//! A glyph is its advance and a path. Numbers are integers, `x y` a point:
//!
//! | Command | Does |
//! | --- | --- |
//! | `Mx y` | begins a stroke |
//! | `Lx y`, `Hx`, `Vy` | straight, sideways, upright to a point |
//! | `Rx y`, `Ux y` | a quarter of an ellipse that sets out sideways and arrives upright, or sets out upright |
//! | `Qa b x y` | an arc around the corner (a, b) of any angle |
//! | `Oa b x y` | an ellipse in the box with these corners |
//! | `Dx y` | a dot |

/// The height of capitals and digits, in units.
pub(super) const CAPITALS: f64 = 70.0;
/// The lines that the glyphs stand between, in units: below descenders, baseline, small letters, capitals.
pub(super) const LINES: [f64; 4] = [-20.0, 0.0, 50.0, CAPITALS];

/// The radius of a dot is larger by this than half a stroke.
const DOT: f64 = 2.0;

/// What a stroke is made of, in units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    Begin([f64; 2]),
    Line([f64; 2]),
    /// Around a corner to an end: a quarter of an ellipse, or its image under a linear map.
    Turn([f64; 2], [f64; 2]),
}

/// Each with its character before it.
const GLYPHS: [&str; 114] = [
    "  26",
    "! 28M14 70V23D14 2",
    "\" 38M12 70V50M26 70V50",
    "# 66M28 68L18 2M48 68L38 2M11 47H57M9 23H55",
    "$ 60M50 56Q46 70 30 70R10 52Q10 40 30 36Q51 32 51 19U30 0Q13 0 8 14M30 80V-10",
    "% 86O9 36 35 70O51 0 77 34M63 70L23 0",
    "& 70M61 0L22 45Q17 51 17 57U31 70R44 57Q44 48 29 40Q10 30 10 18U29 0R59 31",
    "' 24M12 70V50",
    "( 34M26 80Q11 60 11 34Q11 8 26 -12",
    ") 34M8 80Q23 60 23 34Q23 8 8 -12",
    "* 48M24 72V32M7 62L41 42M41 62L7 42",
    "+ 58M29 55V15M9 35H49",
    ", 27M14 2Q14 -7 9 -14D14 2",
    "- 40M9 27H31",
    ". 27D13 2",
    "/ 44M36 76L8 -8",
    "0 58O10 0 48 70",
    "1 58M18 56L35 70V0",
    "2 58M11 53U29 70R47 51Q47 40 36 28L10 0H48",
    "3 58M12 57Q15 70 29 70R46 54U28 37H22M28 37R48 18U28 0Q13 0 10 13",
    "4 58M38 0V70L9 19H50",
    "5 58M45 70H17L14 38Q20 44 29 44R48 22U29 0Q14 0 10 12",
    "6 58M45 59Q41 70 30 70R10 33V22U29 0R48 22U29 44R10 22",
    "7 58M10 70H48L23 0",
    "8 58O12 38 46 70O10 0 48 38",
    "9 58M13 11Q17 0 28 0R48 37V48U29 70R10 48U29 26R48 48",
    ": 27D13 2D13 45",
    "; 27D14 45M14 2Q14 -7 9 -14D14 2",
    "< 58M47 57L11 35L47 13",
    "= 58M9 45H49M9 25H49",
    "> 58M11 57L47 35L11 13",
    "? 52M9 56Q12 70 26 70R43 53Q43 44 34 37Q26 31 26 22D26 2",
    "@ 96O31 16 63 50M63 50V28U74 16R87 34U49 72R9 29U49 -14Q61 -14 71 -8",
    "A 64M6 0L32 70L58 0M15 24H49",
    "B 64M13 37H35R54 18U35 0H13V70H33R50 54U33 37",
    "C 68M59 55Q53 70 36 70R9 35U36 0Q53 0 59 15",
    "D 71M13 0H31R62 35U31 70H13V0",
    "E 59M51 70H13V0H51M13 37H46",
    "F 56M50 70H13V0M13 36H46",
    "G 72M60 55Q54 70 37 70R9 35U37 0R61 26V33H40",
    "H 72M13 0V70M59 0V70M13 37H59",
    "I 28M14 70V0",
    "J 53M40 70V20U23 0Q10 0 7 13",
    "K 63M13 0V70M56 70L13 26M28 41L58 0",
    "L 54M13 70V0H48",
    "M 84M13 0V70L42 16L71 70V0",
    "N 74M13 0V70L61 0V70",
    "O 76O9 0 67 70",
    "P 61M13 0V70H35R54 50U35 30H13",
    "Q 76O9 0 67 70M45 18L66 -5",
    "R 64M13 0V70H35R54 51U35 32H13M35 32L56 0",
    "S 60M50 56Q46 70 30 70R10 52Q10 40 30 36Q51 32 51 19U30 0Q13 0 8 14",
    "T 60M6 70H54M30 70V0",
    "U 70M13 70V23U35 0R57 23V70",
    "V 62M6 70L31 0L56 70",
    "W 90M6 70L25 0L45 70L65 0L84 70",
    "X 60M7 70L53 0M53 70L7 0",
    "Y 60M5 70L30 33L55 70M30 33V0",
    "Z 59M9 70H50L9 0H51",
    "[ 34M26 79H12V-11H26",
    "\\ 44M8 76L36 -8",
    "] 34M8 79H22V-11H8",
    "^ 52M10 42L26 70L42 42",
    "_ 54M3 -12H51",
    "` 32M10 73L20 60",
    "a 56M11 40Q15 50 27 50R44 32V0M44 29H26R10 14U24 0R44 18",
    "b 61M12 70V0M12 34Q17 50 32 50R52 25U32 0Q17 0 12 16",
    "c 54M47 38Q42 50 30 50R9 25U30 0Q42 0 47 12",
    "d 61M49 70V0M49 34Q44 50 29 50R9 25U29 0Q44 0 49 16",
    "e 59M9 27H50U30 50R9 25U31 0Q43 0 48 11",
    "f 38M34 70H30R17 56V0M6 50H32",
    "g 61M49 50V-3U29 -20Q17 -20 12 -11M49 34Q44 50 29 50R9 25U29 0Q44 0 49 16",
    "h 58M12 70V0M12 33Q16 50 30 50R46 33V0",
    "i 26M13 50V0D13 68",
    "j 26M13 50V-8U3 -20H1D13 68",
    "k 54M12 70V0M45 50L12 17M23 28L48 0",
    "l 32M12 70V12U23 0H26",
    "m 88M12 0V50M12 34Q16 50 29 50R44 34V0M44 34Q48 50 61 50R76 34V0",
    "n 58M12 0V50M12 33Q16 50 30 50R46 33V0",
    "o 60O9 0 51 50",
    "p 61M12 50V-20M12 34Q17 50 32 50R52 25U32 0Q17 0 12 16",
    "q 61M49 50V-20M49 34Q44 50 29 50R9 25U29 0Q44 0 49 16",
    "r 40M12 0V50M12 32Q16 50 31 50H35",
    "s 52M43 40Q39 50 26 50R10 37Q10 28 26 26Q44 24 44 14U26 0Q12 0 8 11",
    "t 40M18 64V14U30 0H34M6 50H33",
    "u 58M46 50V0M46 17Q42 0 28 0R12 17V50",
    "v 52M6 50L26 0L46 50",
    "w 76M6 50L22 0L38 50L54 0L70 50",
    "x 51M7 50L44 0M44 50L7 0",
    "y 52M46 50L22 -10Q18 -20 10 -20H7M6 50L26 0",
    "z 50M9 50H41L9 0H42",
    "{ 38M29 79H28R19 68V43U10 34R19 25V0U28 -11H29",
    "| 26M13 79V-11",
    "} 38M9 79H10R19 68V43U28 34R19 25V0U10 -11H9",
    "~ 58M8 30Q14 43 29 35Q44 27 50 40",
    "° 40O8 46 32 70",
    "± 58M29 66V28M9 47H49M9 8H49",
    "² 40M9 60Q10 70 20 70R31 59Q31 53 23 45L8 32H32",
    "³ 40M9 63Q12 70 20 70R30 61U19 52H16M19 52R31 42U19 32Q11 32 8 39",
    "µ 59M12 50V-20M12 17U28 0Q42 0 47 17M47 50V0",
    "· 27D13 35",
    "× 58M14 50L44 20M44 50L14 20",
    "α 63M55 50Q45 0 27 0R9 25U27 50Q45 50 55 0",
    "β 60M12 -20V51U30 70R47 55U31 40H25M31 40R51 20U31 0Q18 0 12 9",
    "δ 58M45 64Q39 70 30 70R16 60Q16 52 30 45Q49 36 49 20U29 0R9 21U29 43Q33 43 37 41",
    "ε 52M43 41Q39 50 27 50R11 38U25 27H31M25 27R8 13U26 0Q39 0 44 10",
    "λ 54M7 70H9Q16 70 20 61L47 0M26 47L7 0",
    "μ 59M12 50V-20M12 17U28 0Q42 0 47 17M47 50V0",
    "– 58M6 30H52",
    "— 86M6 30H80",
    "… 74D13 2D37 2D61 2",
    "→ 80M9 35H70M52 53L70 35L52 17",
    "− 58M9 35H49",
    "∞ 84M42 35Q53 51 62 51R76 35U62 19Q53 19 42 35Q31 51 22 51R8 35U22 19Q31 19 42 35",
];

/// The drawing of characters that are not there.
const UNKNOWN: &str = "58M10 0V70H48V0H10";

fn glyph(character: char) -> &'static str {
    let character = if character.is_whitespace() { ' ' } else { character };
    for glyph in GLYPHS {
        if let Some(glyph) = glyph.strip_prefix(character) {
            return glyph;
        }
    }
    UNKNOWN
}

/// From the left end of a glyph to that of the next one, in units.
pub(super) fn advance(character: char) -> f64 {
    Path { rest: glyph(character).as_bytes() }.number()
}

/// What a character is made of.
pub(super) fn steps(character: char) -> Vec<Step> {
    let mut path = Path { rest: glyph(character).as_bytes() };
    let mut steps = Vec::new();
    path.number();
    let mut at = [0.0; 2];
    while let Some((&command, rest)) = path.rest.split_first() {
        path.rest = rest;
        match command {
            b'M' => {
                at = path.point();
                steps.push(Step::Begin(at));
            }
            b'L' | b'H' | b'V' => {
                let x = if command == b'V' { at[0] } else { path.number() };
                let y = if command == b'H' { at[1] } else { path.number() };
                at = [x, y];
                steps.push(Step::Line(at));
            }
            b'R' | b'U' | b'Q' => {
                let corner = (command == b'Q').then(|| path.point());
                let end = path.point();
                let quarter = if command == b'R' { [end[0], at[1]] } else { [at[0], end[1]] };
                at = end;
                steps.push(Step::Turn(corner.unwrap_or(quarter), end));
            }
            b'O' => ellipse(path.point(), path.point(), &mut steps),
            b'D' => {
                let [x, y] = path.point();
                ellipse([x - DOT, y - DOT], [x + DOT, y + DOT], &mut steps);
            }
            // There are no others.
            _ => {}
        }
    }
    steps
}

fn ellipse([left, low]: [f64; 2], [right, high]: [f64; 2], steps: &mut Vec<Step>) {
    let [x, y] = [0.5 * (left + right), 0.5 * (low + high)];
    steps.push(Step::Begin([left, y]));
    steps.push(Step::Turn([left, high], [x, high]));
    steps.push(Step::Turn([right, high], [right, y]));
    steps.push(Step::Turn([right, low], [x, low]));
    steps.push(Step::Turn([left, low], [left, y]));
}

/// What of a glyph is not read yet.
struct Path {
    rest: &'static [u8],
}

impl Path {
    fn number(&mut self) -> f64 {
        if let Some((b' ', rest)) = self.rest.split_first() {
            self.rest = rest;
        }
        let mut sign = 1.0;
        if let Some((b'-', rest)) = self.rest.split_first() {
            (sign, self.rest) = (-1.0, rest);
        }
        let mut number = 0.0;
        while let Some((digit @ b'0'..=b'9', rest)) = self.rest.split_first() {
            number = 10.0 * number + f64::from(digit - b'0');
            self.rest = rest;
        }
        sign * number
    }

    fn point(&mut self) -> [f64; 2] {
        [self.number(), self.number()]
    }
}
