//! The folder of `closeranks check -o`.

use anyhow::Result;

use super::answer::Answer;
use super::input::Input;
use crate::folder::Folder;

/// Picture and page.
pub(super) fn save(folder: Folder, _input: &Input, _answer: &Answer) -> Result<()> {
    folder.write()
}
