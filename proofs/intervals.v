(* Interval arithmetic on Coq's own integers.

   The tactic `interval` of the library computes with the processor's integers, which Coq takes on trust as axioms. Here it is built on
   integers that Coq defines itself, so that what it proves rests on the real numbers alone. It takes some seconds more. It has to be told
   a precision (`i_prec`): without one the library takes the processor's floating point all the same. *)

From Interval Require Import Specific_stdz Specific_ops Tactic.

Module ExactFloats := SpecificFloat StdZRadix2.
Module ExactIntervals := IntervalTactic ExactFloats.
