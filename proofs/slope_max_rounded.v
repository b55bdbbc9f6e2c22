(* L as it is computed is large enough (crates/core/src/controller/budget/curvature.rs: `slope_max`; docs/theory/weights.md: eq:slope-bound).

   In words. L is f at the point of an interval of s closest to a peak that a rounded root gives, computed with every operation rounded, and raised by a factor 1 + 1e-12.
   0 < q1 <= 4, 0 < q2 <= 1e15, 0 <= R <= 1e6.

   `slope_max_enough`: f(s) is at most this L, and 1e-260, for every real s between the two ends as they are stored. So the factor covers
   all rounding of L for given ends, and that of the peak.
   `slope_max_from_distance`: the ends are rounded too. From a distance d, a move rho and an error E to L: f(s) is at most L + q1 q2/2 1.2e-15 R^2 + 1e-250 for
   every real s that the pair can have. The middle term is what the ends are wrong by. No factor can cover it: where a pair is just within R, the ends
   may be stored as 0, and L with them, while the real f is not 0. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded.
Import ExactIntervals.
Local Open Scope R_scope.
Local Existing Instance prec_53.

Lemma fl_nonneg x : 0 <= x -> 0 <= fl x.
Proof. intro H; rewrite <- fl_zero; apply fl_mono; exact H. Qed.
Lemma least_pos : 0 < least.
Proof. unfold least; apply Rinv_0_lt_compat, IZR_lt; reflexivity. Qed.
Lemma least_is a : a <= 1e30 -> a * least <= 1e-270.
Proof.
intro small; apply Rle_trans with (1e30 * least); [apply Rmult_le_compat_r; [apply Rlt_le, least_pos | exact small] |].
unfold least; apply Rmult_le_reg_r with (IZR (10 ^ 300)); [apply IZR_lt; reflexivity |].
rewrite Rmult_assoc, Rinv_l by (apply not_0_IZR; discriminate); simpl; lra.
Qed.

(* 1.0 + 1e-12 *)
Definition raise := fl (1 + fl 1e-12).
Lemma raise_range : 1 + 9.99e-13 <= raise <= 1 + 1.001e-12.
Proof.
assert (U := u_value); assert (a : Rabs 1e-12 <= 1e-12) by (rewrite Rabs_pos_eq; lra).
assert (F := fl_abs _ _ a); rewrite U in F; apply near in F.
assert (b : Rabs (1 + fl 1e-12) <= 1.1) by (apply Rabs_le; lra).
assert (G := fl_abs _ _ b); rewrite U in G; apply near in G; unfold raise; lra.
Qed.

(* The point of [lo, hi] closest to `peak`. *)
Definition closest peak lo hi := if Rlt_dec peak lo then lo else if Rlt_dec hi peak then hi else peak.
Lemma closest_is peak lo hi : lo <= hi -> closest peak lo hi = Rmax lo (Rmin hi peak).
Proof.
intro le; unfold closest; destruct (Rlt_dec peak lo); [rewrite Rmin_right, Rmax_left by lra; reflexivity |].
destruct (Rlt_dec hi peak); [rewrite Rmin_left, Rmax_right by lra | rewrite Rmin_right, Rmax_right by lra]; reflexivity.
Qed.
Lemma closest_in peak lo hi : lo <= hi -> lo <= closest peak lo hi <= hi.
Proof. intro le; unfold closest; destruct (Rlt_dec peak lo); [lra | destruct (Rlt_dec hi peak); lra]. Qed.
(* Two peaks that are near each other. *)
Lemma closest_two p q d lo hi : lo <= hi -> Rabs (q - p) <= d ->
  closest p lo hi = closest q lo hi \/ (p - d <= closest p lo hi <= p + d /\ p - d <= closest q lo hi <= p + d).
Proof.
intros le D; apply near in D; unfold closest.
destruct (Rlt_dec p lo); destruct (Rlt_dec q lo); try (left; reflexivity);
  destruct (Rlt_dec hi p); destruct (Rlt_dec hi q); try (left; reflexivity); right; lra.
Qed.

Section Most.
Variables q1 q2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Variable far : R -> R.
Hypothesis far_nonneg : forall x, 0 <= far x.
Definition steepest_fl := fl (sqrt (fl (fl (2 * fl steepest_z) / q2))).
Definition slope_max_fl lo hi := fl (raise * f_fl q1 q2 far (closest steepest_fl lo hi)).

Lemma tail_nonneg s : 0 <= s -> 0 <= tail_fl q2 far s.
Proof.
intro s0; assert (x0 : exponent_fl q2 s <= 0).
  assert (a : fl (- q2 * s) <= 0) by (rewrite <- fl_zero; apply fl_mono; assert (0 <= q2 * s) by (apply Rmult_le_pos; lra); lra).
  unfold exponent_fl; rewrite <- fl_zero; apply fl_mono; assert (0 <= - fl (- q2 * s) * s) by (apply Rmult_le_pos; lra); lra.
unfold tail_fl, exp_code; destruct (Rle_dec _ _) as [le | no]; [| apply far_nonneg].
assert (E := exp_error _ (conj le (Rle_trans _ 0 700 x0 ltac:(lra)))); apply near in E; assert (p := exp_pos (exponent_fl q2 s)); rewrite u_value in E; lra.
Qed.

Lemma inverse_nonneg e : 0 <= e -> 0 <= inverse_fl e.
Proof.
intro e0; assert (one : 1 <= fl (1 + e)) by (rewrite <- (fl_whole 1) at 1 by reflexivity; apply fl_mono; lra).
unfold inverse_fl; apply fl_nonneg; unfold Rdiv; rewrite Rmult_1_l; apply Rlt_le, Rinv_0_lt_compat; lra.
Qed.

Lemma f_fl_nonneg s : 0 <= s -> 0 <= f_fl q1 q2 far s.
Proof.
intro s0; assert (t := tail_nonneg s s0); assert (i := inverse_nonneg _ t).
assert (p : forall a b, 0 <= a -> 0 <= b -> 0 <= fl (a * b)) by (intros; apply fl_nonneg, Rmult_le_pos; assumption).
unfold f_fl, factor_fl; repeat (apply p; try assumption); lra.
Qed.

Lemma steepest_near star : 0 <= star -> turn q2 star = 1 -> Rabs (q2 * (star * star) / 2 - steepest_z) <= 1 / 10 ^ 15 ->
  Rabs (steepest_fl - star) <= 2.7e-15 * star.
Proof.
intros star0 _ Z; apply near in Z; assert (U := u_value); assert (S := eta_small); assert (l0 := least_pos); assert (n0 := eta_pos).
assert (L := least_small); unfold steepest_fl, steepest_z in *.
assert (z0 : Rabs 0.5218134477957685 <= 0.53) by (rewrite Rabs_pos_eq; lra).
assert (F := fl_abs _ _ z0); rewrite U in F; apply near in F; set (a := fl 0.5218134477957685) in *.
assert (b0 : Rabs (2 * a) <= 1.05) by (apply Rabs_le; lra).
assert (G := fl_abs _ _ b0); rewrite U in G; apply near in G; set (b := fl (2 * a)) in *.
set (w := star * star) in *; assert (w0 : 0 <= w) by (unfold w; apply Rmult_le_pos; lra).
assert (iq : 1e-15 <= / q2) by (replace 1e-15 with (/ 1e15) by lra; apply Rinv_le_contravar; lra).
set (i := / q2) in *; assert (qi : q2 * i = 1) by (unfold i; apply Rinv_r; lra).
assert (w1 : w = q2 * w * i) by (replace (q2 * w * i) with (q2 * i * w) by ring; rewrite qi; ring).
set (v := q2 * w) in *; assert (bi : Rabs (b * i - w) <= 2.31e-15 * w).
  rewrite w1; replace (b * i - v * i) with ((b - v) * i) by ring; rewrite Rabs_mult, (Rabs_pos_eq i) by lra.
  rewrite <- Rmult_assoc; apply Rmult_le_compat_r; [lra |]; apply Rabs_le; unfold v in *; lra.
assert (big : 1e-15 <= w) by (rewrite w1; apply Rle_trans with (1.04 * i); [lra | apply Rmult_le_compat_r; lra]).
assert (ww : Rabs w <= w) by (rewrite Rabs_pos_eq; lra).
assert (H := fl_of _ _ _ _ bi ww); change (b / q2) with (b * i); set (c := fl (b * i)) in *.
assert (c1 : Rabs (c - w) <= 2.5e-15 * w) by (apply Rle_trans with (1 := H); rewrite U; lra).
apply near in c1; assert (c0 : 0 <= c) by lra; assert (r0 := sqrt_pos c); assert (rr := sqrt_sqrt c c0); set (r := sqrt c) in *.
assert (s0 : 0 < star) by (destruct star0 as [pos | zero]; [exact pos | unfold w in big; rewrite <- zero in big; lra]).
assert (r1 : Rabs (r - star) <= 2.5e-15 * star).
  assert (prod : (r - star) * (r + star) = c - w) by (unfold w; lra).
  assert (cw : Rabs (c - w) <= 2.5e-15 * w) by (apply Rabs_le; lra); rewrite <- prod, Rabs_mult, (Rabs_pos_eq (r + star)) in cw by lra.
  apply Rmult_le_reg_r with star; [exact s0 |].
  apply Rle_trans with (Rabs (r - star) * (r + star)); [apply Rmult_le_compat_l; [apply Rabs_pos | lra] | unfold w in cw; lra].
assert (ss : Rabs star <= star) by (rewrite Rabs_pos_eq; lra).
apply Rle_trans with (1 := fl_of _ _ _ _ r1 ss).
assert (star1 : 1e-15 <= star).
  destruct (Rle_lt_dec 1e-15 star) as [le | lt]; [exact le | exfalso].
  assert (w <= 1e-15 * 1e-15) by (unfold w; apply Rmult_le_compat; lra); lra.
rewrite U; lra.
Qed.

(* What is lost where the peak is not exactly where it should be. *)
Lemma peak_moved star lo hi s : 0 <= star -> turn q2 star = 1 -> Rabs (q2 * (star * star) / 2 - steepest_z) <= 1 / 10 ^ 15 ->
  0 <= lo -> lo <= s <= hi -> f q1 q2 s <= (1 + 7e-15) * f q1 q2 (closest steepest_fl lo hi).
Proof.
intros star0 turns Z lo0 sin; assert (le : lo <= hi) by lra; assert (N := steepest_near star star0 turns Z).
assert (q2_pos : 0 < q2) by lra; assert (q1_nonneg : 0 <= q1) by lra.
assert (most : forall c, lo <= c <= hi -> f q1 q2 c <= f q1 q2 (closest star lo hi)).
  intros c cin; rewrite closest_is by exact le; apply largest_slope; assumption.
apply Rle_trans with (1 := most s sin); set (p := closest star lo hi) in *; set (q := closest steepest_fl lo hi).
assert (pin := closest_in star lo hi le); fold p in pin; assert (qin := closest_in steepest_fl lo hi le); fold q in qin.
assert (fq : 0 <= f q1 q2 q) by (apply f_nonneg; lra); assert (fp : 0 <= f q1 q2 p) by (apply f_nonneg; lra).
destruct (closest_two star steepest_fl _ lo hi le N) as [E | [pn qn]]; [fold p q in E; rewrite <- E; lra |]; fold p in pn; fold q in qn.
assert (star1 : 0 < star).
  destruct star0 as [pos | zero]; [exact pos | exfalso; unfold steepest_z in Z; rewrite <- zero in Z; apply near in Z; lra].
assert (step : exists c, lo <= c <= hi /\ star - 2.7e-15 * star <= c <= star + 2.7e-15 * star /\ Rabs (f q1 q2 p - f q1 q2 q) = Rabs (f' q1 q2 c) * Rabs (p - q)).
  destruct (Rle_lt_dec p q) as [pq | qp].
    destruct (between q1 q2 pq) as [c [cin is]]; exists c; split; [lra | split; [lra |]].
    rewrite Rabs_minus_sym, is, Rabs_mult, (Rabs_minus_sym q p); reflexivity.
  destruct (between q1 q2 (Rlt_le _ _ qp)) as [c [cin is]]; exists c; split; [lra | split; [lra |]].
  rewrite is, Rabs_mult; reflexivity.
destruct step as [c [cin [cn is]]]; assert (c0 : 0 < c) by lra.
assert (fc := most c cin); assert (T := T_tanh q2 c); assert (th := @tanh_range q2 q2_pos c (Rlt_le _ _ c0)).
assert (cc : c * c <= 1.001 * (star * star)).
  apply Rle_trans with ((1 + 2.7e-15) * star * ((1 + 2.7e-15) * star)); [apply Rmult_le_compat; lra |].
  assert (0 < star * star) by (apply Rmult_lt_0_compat; lra); lra.
assert (qc : q2 * (c * c) <= 1.05).
  apply Rle_trans with (q2 * (1.001 * (star * star))); [apply Rmult_le_compat_l; lra |].
  unfold steepest_z in Z; apply near in Z; lra.
assert (qc0 : 0 <= q2 * (c * c)) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
assert (turn_c : 0 <= turn q2 c <= 2.1).
  cbv beta in T; rewrite T, (Rmult_assoc 2); split; [apply Rmult_le_pos; lra |].
  apply Rle_trans with (2 * 1.05 * 1); [apply Rmult_le_compat; lra | lra].
assert (F : Rabs (f' q1 q2 c) * c <= 1.1 * f q1 q2 p).
  rewrite f'_turn; set (front := 2 * q1 * q2 * _ / _).
  assert (f_front : f q1 q2 c = front * c) by (unfold f, front; field; assert (e0 := exp_pos (- (q2 * (c * c)))); lra).
  assert (front0 : 0 <= front).
    assert (g := @f_nonneg q1 q2 q1_nonneg q2_pos c (Rlt_le _ _ c0)); rewrite f_front in g.
    apply Rmult_le_reg_r with c; [exact c0 | lra].
  rewrite Rabs_mult, (Rabs_pos_eq front) by exact front0.
  assert (Rabs (1 - turn q2 c) <= 1.1) by (apply Rabs_le; lra).
  replace (front * Rabs (1 - turn q2 c) * c) with (front * c * Rabs (1 - turn q2 c)) by ring; rewrite <- f_front.
  assert (0 <= f q1 q2 c) by (apply f_nonneg; lra).
  apply Rle_trans with (f q1 q2 c * 1.1); [apply Rmult_le_compat_l; assumption | lra].
assert (lost : Rabs (f q1 q2 p - f q1 q2 q) <= 6.1e-15 * f q1 q2 p).
  apply Rmult_le_reg_r with c; [exact c0 |]; rewrite is; assert (pq : Rabs (p - q) <= 5.41e-15 * c) by (apply Rabs_le; lra).
  assert (g0 := Rabs_pos (f' q1 q2 c)).
  apply Rle_trans with (Rabs (f' q1 q2 c) * (5.41e-15 * c) * c).
    apply Rmult_le_compat_r; [lra | apply Rmult_le_compat_l; assumption].
  assert (Rabs (f' q1 q2 c) * c * c <= 1.1 * f q1 q2 p * c) by (apply Rmult_le_compat_r; lra).
  assert (0 <= f q1 q2 p * c) by (apply Rmult_le_pos; lra); lra.
apply near in lost; lra.
Qed.

Theorem slope_max_enough lo hi s : 0 <= lo -> hi <= 1e13 -> lo <= s <= hi -> f q1 q2 s <= slope_max_fl lo hi + 1e-260.
Proof.
intros lo0 hi_max sin; assert (q2_pos : 0 < q2) by lra; destruct (steepest q2_pos) as [star [star0 [turns Z]]].
assert (M := peak_moved star lo hi s star0 turns Z lo0 sin); assert (le : lo <= hi) by lra.
assert (qin := closest_in steepest_fl lo hi le); unfold slope_max_fl; set (q := closest steepest_fl lo hi) in *.
assert (q0 : 0 <= q <= 1e13) by lra; assert (fq : 0 <= f q1 q2 q) by (apply f_nonneg; lra).
assert (g0 := f_fl_nonneg q (proj1 q0)); assert (rr := raise_range); assert (U := u_value).
assert (L0 : 0 <= raise * f_fl q1 q2 far q) by (apply Rmult_le_pos; lra).
destruct (Rle_lt_dec (q2 * (q * q)) 690) as [near_z | far_z].
  assert (E := f_error q1 q2 q1_range q2_range far q q0 near_z); apply near in E.
  assert (low : (1 - 1.7e-13) * f q1 q2 q - 1e-270 <= f_fl q1 q2 far q).
    assert ((2.13 * (q2 * (q * q)) + 23) * u * f q1 q2 q <= 1.7e-13 * f q1 q2 q).
      apply Rmult_le_compat_r; [exact fq | rewrite U; lra].
    lra.
  assert (G := fl_error (raise * f_fl q1 q2 far q)); rewrite (Rabs_pos_eq (raise * _)) in G by exact L0; apply near in G.
  assert (raised : (1 + 9.99e-13) * f_fl q1 q2 far q <= raise * f_fl q1 q2 far q) by (apply Rmult_le_compat_r; lra).
  assert (n := eta_small); assert (l := least_is 1 ltac:(lra)); rewrite U in G; lra.
assert (L := fl_nonneg _ L0); apply Rle_trans with (1 := M).
assert (tiny : f q1 q2 q <= 1e-262).
  unfold f; set (z := q2 * (q * q)) in *; set (e := exp (- z)); assert (e0 : 0 < e) by apply exp_pos.
  assert (e1 : e <= 1e-299).
    apply Rle_trans with (exp (-690)); [apply Rlt_le, exp_increasing; lra | interval with (i_prec 60)].
  assert (i0 : 0 <= / ((1 + e) * (1 + e)) <= 1).
    assert (1 <= (1 + e) * (1 + e)) by (assert (0 <= e * e) by (apply Rmult_le_pos; lra); lra).
    split; [apply Rlt_le, Rinv_0_lt_compat; lra | rewrite <- Rinv_1; apply Rinv_le_contravar; lra].
  assert (c1 := small_product (2 * q1) q2 8 1e15 ltac:(lra) ltac:(lra)); assert (c2 := small_product _ q _ 1e13 c1 ltac:(lra)).
  assert (c3 := small_product _ e _ 1e-299 c2 ltac:(lra)); assert (c4 := small_product _ _ _ 1 c3 i0).
  unfold Rdiv; lra.
lra.
Qed.

(* The ends, from what the code is told: distance d, longest move rho and error E, m. *)
Section Distance.
Variables radius d rho E : R.
Hypothesis radius_range : 0 <= radius <= 1e6.
Hypothesis d_double : double d.
Hypothesis d_range : 0 <= d <= 1e7.
Hypothesis rho_range : 0 <= rho <= 1e7.
Hypothesis E_range : 0 <= E <= 1e7.
Let R2 := radius * radius.
Definition nearer_fl := Rmax 0 (fl (d - E)).
Definition farther_fl := fl (d + fl (fl (2 * rho) + E)).
Definition low_fl := Rmax 0 (fl (fl (radius * radius) - fl (farther_fl * farther_fl))).
Definition high_fl := fl (fl (radius * radius) - fl (nearer_fl * nearer_fl)).
Definition slope_max := if Rle_dec high_fl 0 then 0 else slope_max_fl low_fl high_fl.

Let n := Rmax 0 (d - E).
Let F := d + (2 * rho + E).

Lemma square_of a b e t : 0 <= b -> 0 <= e <= 1e-9 -> 0 <= t <= 1e-9 -> Rabs (a - b) <= e * b + t -> Rabs (a * a - b * b) <= 2.001 * e * (b * b) + 2.001 * (b * t) + t.
Proof.
intros b0 e0 t0 H; assert (bb : 0 <= b * b) by (apply Rmult_le_pos; assumption).
replace (a * a - b * b) with ((a - b) * (2 * b + (a - b))) by ring; rewrite Rabs_mult.
assert (bt : 0 <= b * t) by (apply Rmult_le_pos; lra); assert (eb : 0 <= e * b) by (apply Rmult_le_pos; lra).
assert (eb1 : e * b <= 1e-9 * b) by (apply Rmult_le_compat_r; lra).
apply Rle_trans with ((e * b + t) * (2.0000001 * b + t)).
  apply Rmult_le_compat; try apply Rabs_pos; [exact H |].
  apply Rle_trans with (1 := Rabs_triang _ _); rewrite (Rabs_pos_eq (2 * b)) by lra; lra.
assert (e * (b * t) <= 1e-9 * (b * t)) by (apply Rmult_le_compat_r; lra).
assert (t * t <= 1e-9 * t) by (apply Rmult_le_compat_r; lra).
assert (0 <= e * (b * b)) by (apply Rmult_le_pos; lra); lra.
Qed.

Lemma nearer_near : Rabs (nearer_fl - n) <= u * n + eta.
Proof.
assert (H := fl_error (d - E)); assert (U := u_pos); assert (e := eta_pos); unfold nearer_fl, n.
destruct (Rle_lt_dec 0 (d - E)) as [pos | neg].
  assert (P := fl_nonneg _ pos); rewrite !Rmax_right by lra; rewrite (Rabs_pos_eq (d - E)) in H by exact pos; exact H.
assert (N : fl (d - E) <= 0) by (rewrite <- fl_zero; apply fl_mono; lra).
rewrite !Rmax_left by lra; rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; lra.
Qed.

Lemma farther_near : Rabs (farther_fl - F) <= 3.001 * u * F + 4 * eta.
Proof.
assert (U := u_value); assert (e := eta_pos); assert (small := eta_small); assert (l := least_small).
assert (A := fl_error (2 * rho)); rewrite (Rabs_pos_eq (2 * rho)) in A by lra.
assert (B : Rabs (fl (2 * rho) + E - (2 * rho + E)) <= u * (2 * rho) + eta) by (replace (_ - _) with (fl (2 * rho) - 2 * rho) by ring; exact A).
assert (B1 : Rabs (2 * rho + E) <= 2 * rho + E) by (rewrite Rabs_pos_eq; lra).
assert (C := fl_of _ _ _ _ B B1); set (b := fl (fl (2 * rho) + E)) in *.
assert (D : Rabs (d + b - F) <= (1 + u) * (u * (2 * rho) + eta) + u * (2 * rho + E) + eta) by (replace (d + b - F) with (b - (2 * rho + E)) by (unfold F; ring); exact C).
assert (D1 : Rabs F <= F) by (rewrite Rabs_pos_eq; unfold F; lra).
apply Rle_trans with (1 := fl_of _ _ _ _ D D1); rewrite U in *; unfold F; lra.
Qed.

Lemma ends_ordered : nearer_fl <= farther_fl.
Proof.
assert (b0 : 0 <= fl (fl (2 * rho) + E)) by (apply fl_nonneg; assert (0 <= fl (2 * rho)) by (apply fl_nonneg; lra); lra).
assert (dd : fl d = d) by (apply round_generic; [apply valid_rnd_N | exact d_double]).
assert (up : d <= farther_fl) by (rewrite <- dd at 1; apply fl_mono; lra).
unfold nearer_fl; apply Rmax_lub; [lra |]; apply Rle_trans with (2 := up); rewrite <- dd at 2; apply fl_mono; lra.
Qed.

Theorem slope_max_from_distance s : Rmax 0 (R2 - F * F) <= s <= R2 - n * n -> f q1 q2 s <= slope_max + q1 * q2 / 2 * (1.2e-15 * R2) + 1e-250.
Proof.
intros [sl sh]; assert (U := u_value); assert (e := eta_pos); assert (small := eta_small); assert (l := least_small); assert (l0 := least_pos).
assert (r := R2_range radius radius_range); fold R2 in r.
assert (s0 : 0 <= s) by (apply Rle_trans with (2 := sl); apply Rmax_l); assert (s1 : R2 - F * F <= s) by (apply Rle_trans with (2 := sl); apply Rmax_r).
assert (n0 : 0 <= n) by apply Rmax_l; assert (n7 : n <= 1e7) by (unfold n; apply Rmax_lub; lra).
assert (F0 : 0 <= F) by (unfold F; lra); assert (F8 : F <= 1e8) by (unfold F; lra).
assert (G := fl_error (radius * radius)); fold R2 in G; rewrite (Rabs_pos_eq R2) in G by lra.
assert (t0 : 0 <= 4 * eta <= 1e-9) by lra; assert (nt : n * eta <= 1e7 * eta) by (apply Rmult_le_compat_r; lra).
assert (Ft : F * (4 * eta) <= 1e8 * (4 * eta)) by (apply Rmult_le_compat_r; lra).
assert (nn0 : 0 <= n * n) by (apply Rmult_le_pos; assumption); assert (FF0 : 0 <= F * F) by (apply Rmult_le_pos; assumption).
assert (T := least_is 1e9 ltac:(lra)); assert (T1 : 1e9 * eta <= 1e-6 * (1e9 * least)) by lra.
(* the high end *)
assert (N := square_of _ _ u eta n0 ltac:(rewrite U; lra) ltac:(lra) nearer_near).
assert (NN : Rabs (n * n) <= n * n) by (rewrite Rabs_pos_eq; lra).
assert (N2 := fl_of _ _ _ _ N NN); set (near2 := fl (nearer_fl * nearer_fl)) in *.
assert (H1 : Rabs (fl R2 - near2 - (R2 - n * n)) <= 4.2 * u * R2 + 1e9 * eta).
  replace (_ - _) with ((fl R2 - R2) - (near2 - n * n)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp.
  rewrite U in *; lra.
assert (H2 : Rabs (R2 - n * n) <= R2) by (apply Rabs_le; lra).
assert (high : Rabs (high_fl - (R2 - n * n)) <= 1e-15 * R2 + 3e9 * eta).
  unfold high_fl; fold R2 near2; apply Rle_trans with (1 := fl_of _ _ _ _ H1 H2); rewrite U; lra.
apply near in high.
(* the low end *)
assert (P := square_of _ _ (3.001 * u) (4 * eta) F0 ltac:(rewrite U; lra) t0 farther_near).
assert (FF : Rabs (F * F) <= F * F) by (rewrite Rabs_pos_eq; lra).
assert (P2 := fl_of _ _ _ _ P FF); set (far2 := fl (farther_fl * farther_fl)) in *.
assert (low : low_fl <= s + 1.2e-15 * R2 + 3e9 * eta).
  unfold low_fl; fold R2 far2; apply Rmax_lub; [lra |].
  assert (P3 : Rabs (far2 - F * F) <= 7.1 * u * (F * F) + 1e9 * eta) by (apply Rle_trans with (1 := P2); rewrite U; lra).
  apply near in G; apply near in P3; destruct (Rle_lt_dec (F * F) (1.01 * R2 + 1e10 * eta)) as [few | many].
    assert (L1 : Rabs (fl R2 - far2 - (R2 - F * F)) <= 8.2 * u * R2 + 2e9 * eta) by (apply Rabs_le; rewrite U in *; lra).
    assert (L2 : Rabs (R2 - F * F) <= R2 + 1e10 * eta) by (apply Rabs_le; lra).
    assert (L3 := fl_of _ _ _ _ L1 L2); apply near in L3; rewrite U in L3; lra.
  assert (neg : fl R2 - far2 <= 0) by (rewrite U in *; lra).
  assert (fl (fl R2 - far2) <= 0) by (rewrite <- fl_zero; apply fl_mono; exact neg); lra.
assert (qq : 0 <= q1 * q2 <= 4e15) by (split; [apply Rmult_le_pos; lra | apply Rle_trans with (4 * 1e15); [apply Rmult_le_compat; lra | lra]]).
assert (tiny : q1 * q2 * (3e9 * eta) <= 1e-260).
  apply Rle_trans with (4e15 * (3e9 * eta)); [apply Rmult_le_compat_r; lra |]; assert (T2 := least_is 1e25 ltac:(lra)); lra.
assert (QR : 0 <= q1 * q2 * R2) by (apply Rmult_le_pos; lra).
assert (moved : forall a, 0 <= a -> Rabs (s - a) <= 1.2e-15 * R2 + 3e9 * eta -> f q1 q2 s <= f q1 q2 a + q1 * q2 / 2 * (1.2e-15 * R2) + 1e-260).
  intros a a0 close_a; assert (M := f_moved q1 q2 q1_range q2_range s a s0 a0); apply near in M.
  assert (q1 * q2 / 2 * Rabs (s - a) <= q1 * q2 / 2 * (1.2e-15 * R2 + 3e9 * eta)) by (apply Rmult_le_compat_l; lra); lra.
unfold slope_max; destruct (Rle_dec high_fl 0) as [none | some].
  assert (M := moved 0 (Rle_refl 0) ltac:(apply Rabs_le; lra)).
  assert (f00 : f q1 q2 0 = 0) by (unfold f; rewrite !Rmult_0_r; unfold Rdiv; rewrite !Rmult_0_l; reflexivity); lra.
assert (lo0 : 0 <= low_fl) by apply Rmax_l.
assert (ordered : low_fl <= high_fl).
  unfold low_fl; apply Rmax_lub; [lra |]; unfold high_fl; apply fl_mono.
  assert (fl (nearer_fl * nearer_fl) <= fl (farther_fl * farther_fl)); [| lra].
  assert (O := ends_ordered); assert (0 <= nearer_fl) by apply Rmax_l; apply fl_mono, Rmult_le_compat; lra.
assert (top : high_fl <= 1e13) by lra.
assert (cin := closest_in s low_fl high_fl ordered); assert (M := slope_max_enough low_fl high_fl _ lo0 top cin).
assert (A := moved (closest s low_fl high_fl) ltac:(lra)); assert (gap : Rabs (s - closest s low_fl high_fl) <= 1.2e-15 * R2 + 3e9 * eta).
  unfold closest; destruct (Rlt_dec s low_fl); [apply Rabs_le; lra |].
  destruct (Rlt_dec high_fl s); apply Rabs_le; lra.
specialize (A gap); lra.
Qed.
End Distance.
End Most.
