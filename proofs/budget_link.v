(* The link weight meets what budget_team.v and budget_free_team.v assume of a weight (docs/theory/weights.md).

   In words. Two robots are at distance d, and in a tick each moves by at most rho. If kappa bounds K for all s from max(0, R^2 - (d + 2
   rho)^2) to R^2 - max(0, d - 2 rho)^2, the curvature bound holds for this tick (`bends`). If L bounds f for all s from max(0, R^2 -
   (d + 2 rho)^2) to R^2 - d^2, the slope bound does (`falls`). The weight lies between 0 and q1/2 = 1 + eps/2, is 0 out of range,
   and its gradient is odd. These are eq:curvature-bound and eq:slope-bound but for the place at which K and f are largest. *)

From Coq Require Import Reals Lra Psatz FunctionalExtensionality.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors weights curvature budget.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Lemma le_of_squares x y : 0 <= y -> x * x <= y * y -> x <= y.
Proof. by move=> y0 le; exact: Rsqr_incr_0_var. Qed.

(* Where a robot at distance d can be after a part of a move. *)
Lemma between_distances (n : nat) (r w : vec n) t d m : 0 <= d -> d * d = sq r -> 0 <= m -> sq w <= m * m -> 0 <= t <= 1 ->
  Rmax 0 (d - m) * Rmax 0 (d - m) <= sq (plus r (times t w)) <= (d + m) * (d + m).
Proof.
move=> d0 dd m0 wm t01; have w0 := sq_nonneg w; have y0 := sqrt_pos (sq w); have yy := sqrt_sqrt _ w0.
have cs := cauchy_schwarz r w; have all0 := sq_nonneg (plus r (times t w)).
move: all0; rewrite sq_plus sq_times dot_times_r -dd.
rewrite -dd in cs; move: (sq w) (sqrt (sq w)) (dot r w) w0 wm y0 yy cs => W y p W0 wm y0 yy cs all0.
have ym : y <= m by apply: le_of_squares; lra.
have dy : 0 <= d * y by exact: Rmult_le_pos.
have cs' : p * p <= d * y * (d * y) by apply: Rle_trans cs _; rewrite -yy; lra.
have hi : p <= d * y by exact: le_of_squares.
have lo : - p <= d * y by apply: le_of_squares => //; lra.
have ty : 0 <= t * y <= m by split; [apply: Rmult_le_pos; lra | have := Rmult_le_compat_r y t 1; lra].
have WE : t * t * W = t * y * (t * y) by rewrite -yy; ring.
split.
  rewrite /Rmax; case: (Rle_dec 0 (d - m)) => h; last by lra.
  have : (d - t * y) * (d - t * y) <= d * d + 2 * (t * p) + t * t * W by rewrite WE; nra.
  have : (d - m) * (d - m) <= (d - t * y) * (d - t * y) by nra.
  lra.
have : d * d + 2 * (t * p) + t * t * W <= (d + t * y) * (d + t * y) by rewrite WE; nra.
have : (d + t * y) * (d + t * y) <= (d + m) * (d + m) by nra.
lra.
Qed.

Section Link.
Variables q1 q2 R2 : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.
Variable n : nat.
Definition link_weight (r : vec n) := weight q1 q2 R2 (sq r).

Lemma link_nonneg r : 0 <= link_weight r. Proof. exact: weight_nonneg. Qed.
Lemma link_height r : link_weight r <= q1 / 2. Proof. exact: weight_below. Qed.
Lemma link_out_of_range r : R2 < sq r -> link_weight r = 0.
Proof. by move=> out; apply: weight_out_of_range; lra. Qed.
Lemma gradient_odd (r : vec n) : gradient q1 q2 R2 (times (-1) r) = times (-1) (gradient q1 q2 R2 r).
Proof.
have E : sq (times (-1) r) = sq r by rewrite sq_times; ring.
by apply: functional_extensionality => c; rewrite /gradient E /times; ring.
Qed.

Variables (r w : vec n) (d rho : R).
Hypothesis distance : 0 <= d /\ d * d = sq r.
Hypothesis rho_nonneg : 0 <= rho.
Hypothesis short : sq w <= 4 * (rho * rho).
Hypothesis inside : sq r <= R2.

Lemma on_the_way t : 0 <= t <= 1 ->
  Rmax 0 (d - 2 * rho) * Rmax 0 (d - 2 * rho) <= sq (plus r (times t w)) <= (d + 2 * rho) * (d + 2 * rho).
Proof. by have [d0 dd] := distance; apply: between_distances => //; lra. Qed.

(* eq:curvature-bound *)
Theorem bends kappa : 0 <= kappa ->
  (forall s, Rmax 0 (R2 - (d + 2 * rho) * (d + 2 * rho)) <= s <= R2 - Rmax 0 (d - 2 * rho) * Rmax 0 (d - 2 * rho) ->
    K q1 q2 R2 s <= kappa) ->
  link_weight (plus r w) >= link_weight r + dot (gradient q1 q2 R2 r) w - kappa / 2 * sq w.
Proof.
move=> k0 bound; rewrite /link_weight; apply: curvature_bound => // t t01 s0; apply: bound.
have [lo hi] := on_the_way t01; move: s0 lo hi; rewrite sq_plus sq_times dot_times_r => s0 lo hi.
by split; [apply: Rmax_lub; lra | lra].
Qed.

(* eq:slope-bound *)
Theorem falls L : 0 <= L ->
  (forall s, Rmax 0 (R2 - (d + 2 * rho) * (d + 2 * rho)) <= s <= R2 - d * d -> f q1 q2 s <= L) ->
  link_weight (plus r w) >= link_weight r - L * pos (sq (plus r w) - sq r).
Proof.
move=> L0 bound; rewrite /link_weight; apply: weight_falls => // s [lo hi]; apply: bound.
have [_ dd] := distance; have [_ far] := on_the_way (conj Rle_0_1 (Rle_refl 1)).
have E : sq (plus r (times 1 w)) = sq (plus r w) by apply: dot_ext => c; rewrite /plus /times; ring.
rewrite E in far; rewrite dd; move: hi; rewrite [Rmax (R2 - sq r) 0]Rmax_left; last lra.
move=> hi; split=> //; apply: Rle_trans lo; rewrite Rmax_comm; apply: Rle_max_compat_r; lra.
Qed.
End Link.
