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
    /// The sentence, as printed or shortened with care.
    pub sentence: String,
    /// Does it hold in these runs?
    pub holds: bool,
    /// The numbers that say so.
    pub numbers: String,
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
    /// Claims.
    pub claims: Vec<Claim>,
    /// Figures.
    pub figures: Vec<Figure>,
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
