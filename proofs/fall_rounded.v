(* How fast a weight falls with the distance, as it is computed (crates/core/src/controller/budget/curvature.rs: `fall_max`; docs/theory/weights.md: eq:fall).

   In words. The code takes 2 R f at the rounded peak of f, or at R^2 as it is stored if that is less, with every operation rounded, and a factor 1 + 1e-12 in front.
   0 < q1 <= 4, 0 < q2 <= 1e15, 0 <= R <= 1e6.

   `fall_enough`: a weight falls from a distance d to a farther d' by at most (d' - d) times this number and 1e-240. So the factor covers all rounding, for every
   weight that can be set. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded slope_max_rounded bend_rounded bend_gap fall.
Local Open Scope R_scope.

Section Fall.
Variables q1 q2 radius : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Hypothesis radius_range : 0 <= radius <= 1e6.
Variable far : R -> R.
Hypothesis far_nonneg : forall x, 0 <= far x.
Let R2 := radius * radius.
Let f := f q1 q2.
Definition place_fl := let low := steepest_fl q2 in let top := fl (radius * radius) in if Rlt_dec low top then low else top.
Definition fall_max_fl := fl (fl (fl (raise * 2) * radius) * f_fl q1 q2 far place_fl).
Let q1_nonneg : 0 <= q1 := Rlt_le _ _ (proj1 q1_range).
Let q2_pos : 0 < q2 := proj1 q2_range.

Variable star : R.
Hypothesis star_nonneg : 0 <= star.
Hypothesis turns : turn q2 star = 1.
Hypothesis star_is : Rabs (q2 * (star * star) / 2 - steepest_z) <= 1 / 10 ^ 15.

Lemma place_range : 0 <= place_fl <= 1e13 /\ q2 * (place_fl * place_fl) <= 1.05.
Proof.
assert (r := R2_range radius radius_range); fold R2 in r; assert (U := u_value); assert (n := eta_small); assert (l := least_small); assert (n0 := eta_pos).
assert (G := fl_error R2); rewrite (Rabs_pos_eq R2) in G by lra; apply near in G; assert (top0 : 0 <= fl R2) by (apply fl_nonneg; lra).
assert (s0 : 0 <= steepest_fl q2) by apply fl_nonneg, sqrt_pos; assert (N := near _ _ _ (steepest_near q2 q2_range star star_nonneg turns star_is)).
assert (p : 0 <= place_fl /\ place_fl <= fl R2 /\ place_fl <= steepest_fl q2) by (unfold place_fl; fold R2; cbv zeta; destruct (Rlt_dec _ _); lra).
split; [rewrite U in G; lra |]; assert (Z := near _ _ _ star_is); unfold steepest_z in Z.
assert (sq : place_fl * place_fl <= (1 + 2.7e-15) * star * ((1 + 2.7e-15) * star)) by (apply Rmult_le_compat; lra).
assert (q2 * (place_fl * place_fl) <= q2 * ((1 + 2.7e-15) * star * ((1 + 2.7e-15) * star))) by (apply Rmult_le_compat_l; lra); lra.
Qed.

(* The real peak, or R^2, and what the code takes. *)
Lemma place_good : f (Rmax 0 (Rmin R2 star)) <= (1 + 8e-15) * f place_fl + 1e-250.
Proof.
assert (r := R2_range radius radius_range); fold R2 in r; assert (U := u_value); assert (n := eta_small); assert (l := least_is 1e29 ltac:(lra)); assert (n0 := eta_pos).
assert (G := fl_error R2); rewrite (Rabs_pos_eq R2) in G by lra; apply near in G; assert (top0 : 0 <= fl R2) by (apply fl_nonneg; lra).
assert (s0 : 0 <= steepest_fl q2) by apply fl_nonneg, sqrt_pos.
assert (is : closest (steepest_fl q2) 0 (fl R2) = place_fl).
  unfold closest, place_fl; fold R2; cbv zeta; destruct (Rlt_dec (steepest_fl q2) 0); [lra |]; destruct (Rlt_dec (fl R2) (steepest_fl q2)); destruct (Rlt_dec (steepest_fl q2) (fl R2)); lra.
assert (P : forall s, 0 <= s <= fl R2 -> f s <= (1 + 7e-15) * f place_fl).
  intros s sin; rewrite <- is; exact (peak_moved q1 q2 q1_range q2_range star 0 (fl R2) s star_nonneg turns star_is (Rle_refl 0) sin).
assert (F0 : 0 <= f place_fl) by (apply f_nonneg; [exact q1_nonneg | exact q2_pos | apply place_range]).
assert (p0 : 0 <= Rmin R2 star) by (apply Rmin_glb; lra); rewrite Rmax_right by exact p0; assert (pR := Rmin_l R2 star); set (p := Rmin R2 star) in *.
destruct (Rle_lt_dec p (fl R2)) as [inside | beyond]; [assert (H := P p (conj p0 inside)); lra |].
assert (T := P (fl R2) (conj top0 (Rle_refl _))).
assert (f_front : forall s, f s = bend_peak.front q1 q2 s * s).
  intro s; unfold f, weights.f, bend_peak.front; assert (e0 := exp_pos (- (q2 * (s * s)))); field; lra.
destruct (Rle_lt_dec R2 1e-280) as [tiny | some].
  assert (M := f_moved q1 q2 q1_range q2_range p 0 p0 (Rle_refl 0)).
  assert (f00 : weights.f q1 q2 0 = 0) by (unfold weights.f; rewrite !Rmult_0_r; unfold Rdiv; rewrite !Rmult_0_l; reflexivity).
  rewrite f00, !Rminus_0_r, (Rabs_pos_eq p) in M by lra; apply Rabs_le_inv in M; fold f in M.
  assert (q1 * q2 / 2 * p <= 4 * 1e15 / 2 * 1e-280) by (apply Rmult_le_compat; [apply Rmult_le_pos; [apply Rmult_le_pos |]; lra | lra | apply Rmult_le_compat_r; [lra | apply Rmult_le_compat; lra] | lra]).
  lra.
assert (small : eta <= 1e-20 * R2) by lra; assert (near_top : p <= (1 + 2e-16) * fl R2) by (rewrite U in G; lra).
assert (D := front_falls q1 q2 q1_nonneg q2_pos (fl R2) p top0 (Rlt_le _ _ beyond)); assert (fr := front_nonneg q1_nonneg q2_pos (fl R2)).
assert (f p <= bend_peak.front q1 q2 (fl R2) * ((1 + 2e-16) * fl R2)).
  rewrite f_front; apply Rle_trans with (bend_peak.front q1 q2 (fl R2) * p); [apply Rmult_le_compat_r | apply Rmult_le_compat_l]; lra.
assert (E := f_front (fl R2)); lra.
Qed.

Lemma steepest_enough : 2 * radius * steepest_slope q1 q2 radius star <= fall_max_fl + 1e-240.
Proof.
unfold steepest_slope; cbv zeta; fold R2 f; assert (P := place_good); destruct place_range as [range z]; unfold fall_max_fl; set (q := place_fl) in *.
assert (U := u_value); assert (n := eta_small); assert (l := least_is 1e30 ltac:(lra)); assert (n0 := eta_pos); assert (l0 := least_pos); assert (rr := raise_range).
assert (E := near _ _ _ (f_error q1 q2 q1_range q2_range far q range ltac:(lra))); fold f in E; assert (F0 : 0 <= f q) by (apply f_nonneg; [exact q1_nonneg | exact q2_pos | lra]).
assert (rate : (2.13 * (q2 * (q * q)) + 23) * u * f q <= 3e-15 * f q) by (apply Rmult_le_compat_r; [exact F0 | rewrite U; lra]).
assert (big : f q <= 2e28).
  assert (M := f_moved q1 q2 q1_range q2_range q 0 (proj1 range) (Rle_refl 0)).
  assert (f00 : weights.f q1 q2 0 = 0) by (unfold weights.f; rewrite !Rmult_0_r; unfold Rdiv; rewrite !Rmult_0_l; reflexivity).
  rewrite f00, !Rminus_0_r, (Rabs_pos_eq q) in M by lra; apply Rabs_le_inv in M; fold f in M.
  assert (q1 * q2 / 2 * q <= 4 * 1e15 / 2 * 1e13) by (apply Rmult_le_compat; [apply Rmult_le_pos; [apply Rmult_le_pos |]; lra | lra | apply Rmult_le_compat_r; [lra | apply Rmult_le_compat; lra] | lra]).
  lra.
assert (g0 := f_fl_nonneg q1 q2 q1_range q2_range far far_nonneg q (proj1 range)); set (g := f_fl q1 q2 far q) in *.
assert (a := fl_low (raise * 2) ltac:(lra)); set (a' := fl (raise * 2)) in *; assert (a0 : 2 * (1 + 9.98e-13) <= a') by (rewrite U in a; lra).
assert (ar : 2 * (1 + 9.98e-13) * radius <= a' * radius) by (apply Rmult_le_compat_r; lra).
assert (b := fl_low (a' * radius) ltac:(lra)); set (b' := fl (a' * radius)) in *; assert (b0 : 0 <= b') by (apply fl_nonneg; lra).
set (c := 2 * (1 + 9.9e-13) * radius); assert (c0 : 0 <= c <= 3e6) by (unfold c; lra); assert (cb : c - 2 * eta <= b') by (unfold c; rewrite U in b; lra).
assert (p := product_low b' g c (f q) (2 * eta) (3e-15 * f q + 1e-270) b0 g0 (proj1 c0) F0 ltac:(lra) ltac:(lra) cb ltac:(lra)).
assert (h := fl_low (b' * g) ltac:(apply Rmult_le_pos; assumption)).
assert (e1 : eta * f q <= eta * 2e28) by (apply Rmult_le_compat_l; lra); assert (cf : 0 <= radius * f q) by (apply Rmult_le_pos; lra).
assert (up : radius * f (Rmax 0 (Rmin R2 star)) <= radius * ((1 + 8e-15) * f q + 1e-250)) by (apply Rmult_le_compat_l; lra).
unfold c in *; rewrite U in h; lra.
Qed.
End Fall.

Theorem fall_enough q1 q2 radius far d d' : 0 < q1 <= 4 -> 0 < q2 <= 1e15 -> 0 <= radius <= 1e6 -> (forall x, 0 <= far x) -> 0 <= d -> d <= d' ->
  weight q1 q2 (radius * radius) (d * d) - weight q1 q2 (radius * radius) (d' * d') <= (fall_max_fl q1 q2 radius far + 1e-240) * (d' - d).
Proof.
intros a b c F d0 dd; destruct (steepest (proj1 b)) as [star [star0 [turns Z]]].
assert (H := fall (Rlt_le _ _ (proj1 a)) (proj1 b) (proj1 c) star0 turns d0 dd); assert (S := steepest_enough q1 q2 radius a b c far F star star0 turns Z).
apply Rle_trans with (1 := H), Rmult_le_compat_r; [lra | exact S].
Qed.
