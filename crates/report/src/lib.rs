//! What people look at: figures as SVG and PNG, tables, claims, Parquet files and one self-contained page.
//!
//! Everything is made in memory; only the caller writes files.

pub mod claims;
pub mod content;
pub mod table;
