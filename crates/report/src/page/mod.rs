//! What a page or a terminal shows: tables, claims, and one self-contained HTML page.

pub mod claims;
pub mod content;
pub mod html;
pub mod table;

mod html_table;
mod text_table;
