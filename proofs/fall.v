(* How fast a link weight falls with the distance (docs/theory/weights.md, eq:fall).

   In words. Between distances d <= d' the weight falls by at most 2 R L (d' - d), where L is f at the point of [0, R^2] closest to its peak
   (`fall`). d' may be out of range, where the weight is 0. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import weights peak.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Fall.
Variables q1 q2 radius star : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.
Hypothesis radius_nonneg : 0 <= radius.
Hypothesis star_nonneg : 0 <= star.
Hypothesis turns : turn q2 star = 1.
Let R2 := radius * radius.
Definition steepest_slope := f q1 q2 (Rmax 0 (Rmin R2 star)).

Lemma rise_of_distance_derive t : derivable_pt_lim (fun t => rise q1 q2 (R2 - t * t)) t (f q1 q2 (R2 - t * t) * (-2 * t)).
Proof.
apply: (derivable_pt_lim_comp (fun t => R2 - t * t) (rise q1 q2)).
  by apply/is_derive_Reals; move: R2 => c; auto_derive => //; ring.
by apply/is_derive_Reals; exact: rise_derive.
Qed.

Lemma fall_inside d d' : 0 <= d -> d <= d' -> d' <= radius ->
  rise q1 q2 (R2 - d * d) - rise q1 q2 (R2 - d' * d') <= 2 * radius * steepest_slope * (d' - d).
Proof.
move=> d0 [lt | ->] dR; last by lra.
have [c [E cin]] : exists c, rise q1 q2 (R2 - d' * d') - rise q1 q2 (R2 - d * d) =
    f q1 q2 (R2 - c * c) * (-2 * c) * (d' - d) /\ d < c < d'.
  apply: (MVT_cor2 (fun t => rise q1 q2 (R2 - t * t)) (fun t => f q1 q2 (R2 - t * t) * (-2 * t))) => // t _.
  exact: rise_of_distance_derive.
have s0 : 0 <= R2 - c * c <= R2 by rewrite /R2; nra.
have low := f_nonneg q1_nonneg q2_pos (proj1 s0).
have high := largest_slope q1_nonneg q2_pos star_nonneg turns (Rle_refl 0) s0; rewrite -/steepest_slope in high.
have both : f q1 q2 (R2 - c * c) * c <= steepest_slope * radius by apply: Rmult_le_compat; lra.
have : f q1 q2 (R2 - c * c) * c * (d' - d) <= steepest_slope * radius * (d' - d) by apply: Rmult_le_compat_r; lra.
lra.
Qed.

Theorem fall d d' : 0 <= d -> d <= d' ->
  weight q1 q2 R2 (d * d) - weight q1 q2 R2 (d' * d') <= 2 * radius * steepest_slope * (d' - d).
Proof.
move=> d0 dd; have inside t : 0 <= t -> t <= radius -> weight q1 q2 R2 (t * t) = rise q1 q2 (R2 - t * t).
  by move=> t0 tR; rewrite /weight Rmax_left //; rewrite /R2; nra.
have outside t : radius <= t -> weight q1 q2 R2 (t * t) = 0.
  by move=> tR; apply: weight_out_of_range; rewrite /R2; nra.
case: (Rle_lt_dec d' radius) => h'.
  by rewrite !inside; try lra; exact: fall_inside.
have top : 0 <= Rmax 0 (Rmin R2 star) by exact: Rmax_l.
have L0 := f_nonneg q1_nonneg q2_pos top; rewrite -/steepest_slope in L0.
rewrite (outside d'); last lra.
case: (Rle_lt_dec d radius) => h.
  have E := outside radius (Rle_refl _); rewrite inside in E; [| lra | lra].
  have := fall_inside d0 h (Rle_refl _); rewrite E inside // => le.
  have : 2 * radius * steepest_slope * (radius - d) <= 2 * radius * steepest_slope * (d' - d).
    by apply: Rmult_le_compat_l; [apply: Rmult_le_pos; lra | lra].
  lra.
rewrite (outside d); last lra.
have : 0 <= 2 * radius * steepest_slope * (d' - d) by apply: Rmult_le_pos; [apply: Rmult_le_pos; lra | lra].
lra.
Qed.
End Fall.
