//! What a page or terminal shows, before it has a shape.

/// A table of short texts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Heads of the columns.
    pub heads: Vec<String>,
    /// One line each.
    pub rows: Vec<Vec<String>>,
}

/// A sentence of a paper, and whether it holds here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The sentence.
    pub sentence: String,
    /// These are the words of the paper; else it is what they come to, in ours.
    pub is_quotation: bool,
    /// Does it hold in these runs?
    pub holds: bool,
    /// The numbers that say so.
    pub numbers: String,
}

/// What became of a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// It held at every tick.
    Held,
    /// It was broken although the scenario expects it to hold.
    Broken,
    /// It was broken, and the scenario does not expect it to hold.
    NotExpected,
}

/// A law of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LawLine {
    /// Its name.
    pub law: String,
    /// What it demands.
    pub demand: String,
    /// What became of it.
    pub mark: Mark,
    /// How often it was broken, where first and by how much; empty if it held.
    pub detail: String,
}

/// A text to be copied, such as a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listing {
    /// One sentence above it.
    pub caption: String,
    /// The text, line by line.
    pub text: String,
}

/// A file that lies beside the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// Its name.
    pub file: String,
    /// What is in it.
    pub what: String,
}

impl Link {
    /// A link to `file`.
    #[must_use]
    pub fn new(file: impl Into<String>, what: impl Into<String>) -> Self {
        Self { file: file.into(), what: what.into() }
    }
}

/// A figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// One or two sentences below it.
    pub caption: String,
    /// The picture, a complete SVG document.
    pub svg: String,
}

/// A part of a page.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Section {
    /// Its head.
    pub title: String,
    /// What to see in it.
    pub paragraphs: Vec<String>,
    /// Tables with a caption each.
    pub tables: Vec<(String, Table)>,
    /// Laws of a run.
    pub laws: Vec<LawLine>,
    /// Claims.
    pub claims: Vec<Claim>,
    /// Figures.
    pub figures: Vec<Figure>,
    /// Texts to be copied.
    pub listings: Vec<Listing>,
    /// Files beside the page.
    pub files: Vec<Link>,
}

/// A whole page.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Page {
    /// Its title.
    pub title: String,
    /// One or two sentences below the title.
    pub lead: String,
    /// Its parts.
    pub sections: Vec<Section>,
    /// The last line: version, commit, command.
    pub footer: String,
}
