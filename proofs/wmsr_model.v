(* The model of trim.v on whole numbers, as a program that writes tables of cases for the Rust function
   (crates/core/tests/wmsr_model.rs). `answer` is the very `cut` of which trim.v proves `update_is_wmsr`, used with the
   order of Coq's integers. The mean is left as a sum and a count, so that nothing is rounded here. *)

From Coq Require Import ZArith Extraction ExtrOcamlBasic ExtrOcamlZInt ExtrOcamlNatInt.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import trim.

(* Dropped below, dropped above, kept in rising order, and own value plus all that is kept. *)
Definition answer (F : nat) (own : Z) (told : seq Z) : nat * nat * seq Z * Z :=
  let: (small, large, kept) := cut Z.leb Z.ltb F own told in
  (small, large, kept, foldl Z.add own kept).

Extraction Language OCaml.
Extraction "model.ml" answer.
