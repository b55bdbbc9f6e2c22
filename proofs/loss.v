(* What may be lost in a tick (docs/theory/budget.md: eq:loss).

   In words. s(h) = gamma h lies between 0 and h and never falls. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Loss.
Variable gamma : R.
Hypothesis gamma01 : 0 < gamma <= 1.

Definition loss (h : R) := gamma * h.

(* eq:loss *)
Lemma loss_range h : 0 <= h -> 0 <= loss h <= h.
Proof. by move=> h0; rewrite /loss; nra. Qed.

(* eq:loss *)
Lemma loss_mono h k : 0 <= h -> h <= k -> loss h <= loss k.
Proof. by move=> h0 hk; rewrite /loss; nra. Qed.
End Loss.
