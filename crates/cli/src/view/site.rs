//! The files of the page. They are built by `bindings/web/build.sh` and lie in this program.

use std::borrow::Cow;

/// What lines of JSON are called.
pub(crate) const MOMENTS_KIND: &str = "application/jsonl; charset=utf-8";

/// One file.
#[derive(Debug)]
pub(crate) struct File {
    pub(crate) name: &'static str,
    pub(crate) kind: &'static str,
    pub(crate) bytes: Cow<'static, [u8]>,
}

/// All files, the first of which is the page.
#[derive(Debug)]
pub(crate) struct Site(Vec<File>);

const INDEX: &str = include_str!("../../../../bindings/web/site/index.html");

/// Where the page is told what to open.
const TOLD: &str = "<!-- told -->";
const SCENARIO: &str = "scenario.toml";
/// What a run looked like, or looks like now.
pub(crate) const MOMENTS: &str = "moments.jsonl";

/// What the page is to open.
#[derive(Debug, Default)]
pub(crate) struct Shown {
    /// In the sandbox.
    pub(crate) scenario: Option<String>,
    /// Above it, to be looked at.
    pub(crate) moments: Moments,
}

/// A run that the page does not compute.
#[derive(Debug, Default)]
pub(crate) enum Moments {
    /// None.
    #[default]
    Nothing,
    /// All of it.
    Recorded(String),
    /// The server knows its lines.
    Live,
}

impl Site {
    /// The page, which opens with what is to be shown.
    pub(crate) fn new(shown: Shown) -> Self {
        let meta = |name: &str, file: &str| format!("<meta name=\"closeranks-{name}\" content=\"{file}\">");
        let mut told = String::new();
        if shown.scenario.is_some() {
            told.push_str(&meta("scenario", SCENARIO));
        }
        if !matches!(shown.moments, Moments::Nothing) {
            told.push_str(&meta("moments", MOMENTS));
        }
        let index = if told.is_empty() { INDEX.into() } else { INDEX.replacen(TOLD, &told, 1).into() };
        let file = |name, kind, bytes: &'static [u8]| File { name, kind, bytes: bytes.into() };
        let mut files = vec![
            File { name: "index.html", kind: "text/html; charset=utf-8", bytes: into_bytes(index) },
            file(
                "page.js",
                "text/javascript; charset=utf-8",
                include_bytes!("../../../../bindings/web/site/page.js"),
            ),
            file(
                "page.css",
                "text/css; charset=utf-8",
                include_bytes!("../../../../bindings/web/site/page.css"),
            ),
            file(
                "closeranks.wasm",
                "application/wasm",
                include_bytes!("../../../../bindings/web/site/closeranks.wasm"),
            ),
        ];
        if let Some(text) = shown.scenario {
            let bytes = text.into_bytes().into();
            files.push(File { name: SCENARIO, kind: "application/toml; charset=utf-8", bytes });
        }
        if let Moments::Recorded(lines) = shown.moments {
            files.push(File { name: MOMENTS, kind: MOMENTS_KIND, bytes: lines.into_bytes().into() });
        }
        Self(files)
    }

    /// The file of an address's path.
    pub(crate) fn at(&self, path: &str) -> Option<&File> {
        let name = path.strip_prefix('/')?;
        let name = if name.is_empty() { "index.html" } else { name };
        self.0.iter().find(|file| file.name == name)
    }

    pub(crate) fn files(&self) -> &[File] {
        &self.0
    }

    pub(crate) fn into_files(self) -> Vec<File> {
        self.0
    }
}

fn into_bytes(text: Cow<'static, str>) -> Cow<'static, [u8]> {
    match text {
        Cow::Borrowed(text) => text.as_bytes().into(),
        Cow::Owned(text) => text.into_bytes().into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_a_place_where_it_is_told_what_to_open() {
        assert_eq!(INDEX.matches(TOLD).count(), 1);
        let index = |site: &Site| String::from_utf8(site.0[0].bytes.to_vec()).unwrap();
        assert!(!index(&Site::new(Shown::default())).contains("<meta name=\"closeranks-"));
        let all = Site::new(Shown { scenario: Some(String::new()), moments: Moments::Live });
        assert!(index(&all).contains("content=\"scenario.toml\""));
        assert!(index(&all).contains("content=\"moments.jsonl\""));
    }

    #[test]
    fn paths_lead_to_files_and_nowhere_else() {
        let site = Site::new(Shown { scenario: Some("seed = 7\n".to_owned()), ..Shown::default() });
        assert_eq!(site.at("/").map(|file| file.name), Some("index.html"));
        assert_eq!(site.at("/scenario.toml").map(|file| &*file.bytes), Some(&b"seed = 7\n"[..]));
        for path in ["", "page.js", "//page.js", "/../Cargo.toml", "/page.js/", "/nothing"] {
            assert!(site.at(path).is_none(), "{path}");
        }
        assert!(Site::new(Shown::default()).at("/scenario.toml").is_none());
    }
}
