//! Figures, tables, Parquet.
