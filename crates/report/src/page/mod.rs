//! What a page or a terminal shows: tables, claims, sentences, numbers, and one self-contained HTML page.

pub mod claims;
pub mod comparison;
pub mod content;
pub mod html;
pub mod numbers;
pub mod problems;
pub mod sentences;
pub mod table;

mod html_table;
mod text_table;
