//! The files of the page. They are built by `bindings/web/build.sh` and lie in this program.

use std::borrow::Cow;

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

impl Site {
    /// The page, whose sandbox opens with a scenario if one is given.
    pub(crate) fn new(scenario: Option<&str>) -> Self {
        let told = format!("<meta name=\"closeranks-scenario\" content=\"{SCENARIO}\">");
        let index = if scenario.is_some() { INDEX.replacen(TOLD, &told, 1).into() } else { INDEX.into() };
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
        if let Some(text) = scenario {
            let bytes = text.as_bytes().to_vec().into();
            files.push(File { name: SCENARIO, kind: "application/toml; charset=utf-8", bytes });
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
        assert!(!index(&Site::new(None)).contains("closeranks-scenario"));
        assert!(index(&Site::new(Some(""))).contains("content=\"scenario.toml\""));
    }

    #[test]
    fn paths_lead_to_files_and_nowhere_else() {
        let site = Site::new(Some("seed = 7\n"));
        assert_eq!(site.at("/").map(|file| file.name), Some("index.html"));
        assert_eq!(site.at("/scenario.toml").map(|file| &*file.bytes), Some(&b"seed = 7\n"[..]));
        for path in ["", "page.js", "//page.js", "/../Cargo.toml", "/page.js/", "/nothing"] {
            assert!(site.at(path).is_none(), "{path}");
        }
        assert!(Site::new(None).at("/scenario.toml").is_none());
    }
}
