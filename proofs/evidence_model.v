(* The checkers of evidence.v, roles.v and spectrum_evidence.v as programs: check.sh gives them evidence that the Rust program wrote, and wrong evidence. *)

From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlNatInt.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import evidence roles spectrum_evidence.

Extraction Language OCaml.
Extraction "evidence_checker.ml" refutes_check degrees_check order_check search_check searched_order_check Domain eigen_check.
