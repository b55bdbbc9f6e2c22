(* kappa from a distance, with the ends of its interval rounded (crates/core/src/controller/budget/curvature.rs: `bend_max`).

   In words. `bend_rounded.v` is about K between two ends as they are stored. Here they come from a distance d, a longest move rho and an error E, as the code computes
   them, with 2 rho + E <= R. 0 < q1 <= 4, 0 < q2 <= 1e15, 0 <= R <= 1e6 and sqrt(q2) R^2 <= 150.5, which holds of whatever `budget` chooses (150, and what is rounded of it).

   `bend_max_from_distance`: for every distance that the pair can have, K is at most kappa + 1.2e-15 R^2 q1 q2 (3.2 + 6 sqrt(q2) R^2) + 1e-240, if K at the stored
   peak is at least the largest K divided by 1 + 1e-13. The middle term is what the ends are wrong by, times the steepest slope of K (`bend_slope_bound`: the slope of f' is at most
   1.5 q1 q2 sqrt(q2)). The condition is met: `stored_peak` in bend_peak_rounded.v. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded slope_max_rounded bend_rounded.
Import ExactIntervals.
Local Open Scope R_scope.
Local Existing Instance prec_53.

Definition bend_slope x := 2 * exp (- (x * x)) / ((1 + exp (- (x * x))) * (1 + exp (- (x * x)))) *
  (4 * x * ((1 - exp (- (x * x))) / (1 + exp (- (x * x)))) + 8 * (x * x * x) * exp (- (x * x)) / ((1 + exp (- (x * x))) * (1 + exp (- (x * x)))) -
   2 * x * ((1 - exp (- (x * x))) / (1 + exp (- (x * x)))) * (2 * (x * x) * ((1 - exp (- (x * x))) / (1 + exp (- (x * x)))) - 1)).

Lemma bend_slope_near x : 0 <= x <= 4 -> Rabs (bend_slope x) <= 1.5.
Proof. intros [a b]; unfold bend_slope; interval with (i_bisect x, i_taylor x, i_depth 30, i_prec 50). Qed.

Lemma bend_slope_far x : 4 <= x -> Rabs (bend_slope x) <= 1.5.
Proof.
intro x4; unfold bend_slope; assert (e0 := exp_pos (- (x * x))).
assert (big : 1 + x * x / 4 <= exp (x * x / 4)) by apply exp_ineq1_le.
assert (H54 : 54 <= exp (x * x / 4)).
  apply Rle_trans with (exp 4); [interval with (i_prec 60) |].
  assert (4 * 4 <= x * x) by (apply Rmult_le_compat; lra).
  destruct (Req_dec (x * x / 4) 4) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra].
assert (inv : exp (- (x * x)) * (exp (x * x / 4) * exp (x * x / 4) * exp (x * x / 4) * exp (x * x / 4)) = 1).
  rewrite <- !exp_plus, <- exp_0; f_equal; field.
set (e := exp (- (x * x))) in *; set (H := exp (x * x / 4)) in *.
assert (xH : x <= H) by (assert (0 <= (x - 4) * x) by (apply Rmult_le_pos; lra); lra).
assert (HH : 54 * H <= H * H) by (apply Rmult_le_compat_r; lra).
assert (xx : x * x <= H * H) by (apply Rmult_le_compat; lra).
assert (H3 : 0 <= H * H * H) by (repeat apply Rmult_le_pos; lra).
assert (xxx : x * x * x <= H * H * H) by (apply Rmult_le_compat; [apply Rmult_le_pos; lra | lra | lra | lra]).
assert (eH : e * (H * H * H) * 54 <= 1).
  assert (e * (H * H * H) * 54 <= e * (H * H * H) * H) by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra | lra]); lra.
assert (c3 : 0 <= e * (x * x * x) <= 1 / 54).
  split; [repeat apply Rmult_le_pos; lra |]; assert (e * (x * x * x) <= e * (H * H * H)) by (apply Rmult_le_compat_l; lra); lra.
assert (x16 : 16 * x <= x * x * x) by (assert (4 * 4 <= x * x) by (apply Rmult_le_compat; lra); apply Rmult_le_compat_r; lra).
assert (c1 : 0 <= e * x <= 1 / 864).
  split; [apply Rmult_le_pos; lra |]; assert (e * (16 * x) <= e * (x * x * x)) by (apply Rmult_le_compat_l; lra); lra.
set (h := (1 - e) / (1 + e)); set (j := / ((1 + e) * (1 + e))).
assert (e1 : e <= 1).
  unfold e; rewrite <- exp_0; apply Rlt_le, exp_increasing; assert (4 * 4 <= x * x) by (apply Rmult_le_compat; lra); lra.
assert (h0 : 0 <= h <= 1).
  assert (i0 : 0 < / (1 + e)) by (apply Rinv_0_lt_compat; lra); unfold h, Rdiv; split; [apply Rmult_le_pos; lra |].
  apply Rmult_le_reg_r with (1 + e); [lra | rewrite Rmult_assoc, Rinv_l by lra; lra].
assert (j0 : 0 <= j <= 1).
  unfold j; assert (1 <= (1 + e) * (1 + e)) by (assert (0 <= e * e) by (apply Rmult_le_pos; lra); lra).
  split; [apply Rlt_le, Rinv_0_lt_compat; lra | rewrite <- Rinv_1; apply Rinv_le_contravar; lra].
replace (2 * e / ((1 + e) * (1 + e)) * (4 * x * h + 8 * (x * x * x) * e / ((1 + e) * (1 + e)) - 2 * x * h * (2 * (x * x) * h - 1)))
  with (j * (6 * h * (2 * (e * x)) + 16 * (e * (x * x * x)) * (e * j) - 8 * (h * h) * (e * (x * x * x)))) by (unfold j; field; lra).
assert (p1 := small_product h (e * x) 1 (1 / 864) h0 c1); assert (ej := small_product e j 1 1 ltac:(lra) j0).
assert (p2 := small_product _ _ _ _ c3 ej); assert (hh := small_product h h 1 1 h0 h0); assert (p3 := small_product _ _ _ _ hh c3).
set (B := 6 * h * (2 * (e * x)) + 16 * (e * (x * x * x)) * (e * j) - 8 * (h * h) * (e * (x * x * x))).
assert (BB : Rabs B <= 1) by (apply Rabs_le; unfold B; lra).
rewrite Rabs_mult, (Rabs_pos_eq j) by lra; apply Rle_trans with (1 * 1); [apply Rmult_le_compat; try apply Rabs_pos; lra | lra].
Qed.

Section Ends.
Variables q1 q2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.

Theorem bend_slope_bound s : 0 <= s -> Rabs (g1 q1 q2 s) <= 1.5 * (q1 * q2 * sqrt q2).
Proof.
intro s0; assert (r0 := sqrt_pos q2); assert (rr := sqrt_sqrt q2 ltac:(lra)); set (r := sqrt q2) in *.
assert (is : g1 q1 q2 s = q1 * q2 * r * bend_slope (r * s)).
  assert (e0 := exp_pos (- (r * s * (r * s)))).
  unfold g1, T1, bend_peak.front, turn, tanh', bend_slope; rewrite <- rr.
  replace (r * r * (s * s)) with (r * s * (r * s)) by ring; field; lra.
assert (x0 : 0 <= r * s) by (apply Rmult_le_pos; lra).
assert (b : Rabs (bend_slope (r * s)) <= 1.5) by (destruct (Rle_lt_dec (r * s) 4); [apply bend_slope_near | apply bend_slope_far]; lra).
assert (Q : 0 <= q1 * q2 * r) by (apply Rmult_le_pos; [apply Rmult_le_pos |]; lra).
rewrite is, Rabs_mult, (Rabs_pos_eq (q1 * q2 * r)) by exact Q.
assert (q1 * q2 * r * Rabs (bend_slope (r * s)) <= q1 * q2 * r * 1.5) by (apply Rmult_le_compat_l; assumption); lra.
Qed.

(* The second term of K, without its factor. *)
Let m s := Rmax 0 (- f' q1 q2 s).

Lemma m_moved a b : 0 <= a -> 0 <= b -> Rabs (m a - m b) <= 1.5 * (q1 * q2 * sqrt q2) * Rabs (a - b).
Proof.
assert (up : forall a b, 0 <= a -> a <= b -> Rabs (g q1 q2 b - g q1 q2 a) <= 1.5 * (q1 * q2 * sqrt q2) * Rabs (b - a)).
  intros c d c0 cd; destruct cd as [cd | ->]; [| rewrite !Rminus_diag_eq, Rabs_R0 by reflexivity; lra].
  destruct (MVT_cor2 (g q1 q2) (g1 q1 q2) c d cd) as [x [is xin]].
    intros t _; apply is_derive_Reals, g_derive.
  rewrite is, Rabs_mult; apply Rmult_le_compat_r; [apply Rabs_pos | apply bend_slope_bound; lra].
intros a0 b0; unfold m; rewrite <- !g_f.
assert (part : Rabs (Rmax 0 (g q1 q2 a) - Rmax 0 (g q1 q2 b)) <= Rabs (g q1 q2 a - g q1 q2 b)).
  assert (h1 := Rle_abs (g q1 q2 a - g q1 q2 b)); assert (h2 := Rle_abs (- (g q1 q2 a - g q1 q2 b))); rewrite Rabs_Ropp in h2.
  apply Rabs_le; unfold Rmax; destruct (Rle_dec 0 (g q1 q2 a)); destruct (Rle_dec 0 (g q1 q2 b)); lra.
apply Rle_trans with (1 := part); destruct (Rle_lt_dec a b) as [le | lt]; [rewrite Rabs_minus_sym, (Rabs_minus_sym a b); apply up; lra | apply up; lra].
Qed.

Lemma m_range s : 0 <= s -> 0 <= m s <= q1 * q2 / 2.
Proof.
intro s0; assert (F := f'_range q1 q2 q1_range q2_range s s0); apply Rabs_le_inv in F; unfold m; split; [apply Rmax_l |].
assert (0 <= q1 * q2) by (apply Rmult_le_pos; lra); apply Rmax_lub; lra.
Qed.

Variable far : R -> R.
Hypothesis far_nonneg : forall x, 0 <= far x.
Variables radius d rho E : R.
Hypothesis radius_range : 0 <= radius <= 1e6.
Hypothesis steep : sqrt q2 * (radius * radius) <= 150.5.
Hypothesis d_double : double d.
Hypothesis d_range : 0 <= d <= 1e7.
Hypothesis rho_range : 0 <= rho.
Hypothesis E_range : 0 <= E.
Hypothesis reach_small : 2 * rho + E <= radius.
Let R2 := radius * radius.
Definition square_fl := fl (radius * radius).
Definition near_fl := Rmax 0 (fl (d - fl (fl (2 * rho) + E))).
Definition top_fl := fl (square_fl - fl (near_fl * near_fl)).
Definition bend_max peak := if Rle_dec top_fl 0 then 0 else bend_max_fl q1 q2 square_fl far peak (low_fl radius d rho E) top_fl.

Let n := Rmax 0 (d - (2 * rho + E)).
Let F := d + (2 * rho + E).

Lemma near_near : Rabs (near_fl - n) <= 2.1 * u * radius + u * n + 4 * eta.
Proof.
assert (U := u_value); assert (e := eta_pos); assert (A := fl_error (2 * rho)); rewrite (Rabs_pos_eq (2 * rho)) in A by lra.
assert (B : Rabs (fl (2 * rho) + E - (2 * rho + E)) <= u * (2 * rho) + eta) by (replace (_ - _) with (fl (2 * rho) - 2 * rho) by ring; exact A).
assert (B1 : Rabs (2 * rho + E) <= 2 * rho + E) by (rewrite Rabs_pos_eq; lra).
assert (C := fl_of _ _ _ _ B B1); set (b := fl (fl (2 * rho) + E)) in *.
assert (G := fl_error (d - b)); unfold near_fl, n; fold b; set (w := d - (2 * rho + E)) in *.
assert (D : Rabs (d - b - w) <= (1 + u) * (u * (2 * rho) + eta) + u * (2 * rho + E)+ eta).
  replace (d - b - w) with (- (b - (2 * rho + E))) by (unfold w; ring); rewrite Rabs_Ropp; exact C.
assert (D1 : Rabs (d - b) <= Rabs w + ((1 + u) * (u * (2 * rho) + eta) + u * (2 * rho + E) + eta)).
  replace (d - b) with (w + (d - b - w)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra.
assert (small := eta_small); assert (l := least_small).
destruct (Rle_lt_dec 0 w) as [pos | neg].
  rewrite (Rabs_pos_eq w) in D1 by exact pos; rewrite (Rmax_right 0 w) by exact pos.
  apply near in D; assert (u * Rabs (d - b) <= u * (w + ((1 + u) * (u * (2 * rho) + eta) + u * (2 * rho + E) + eta))) by (apply Rmult_le_compat_l; [rewrite U |]; lra).
  apply near in G; apply Rabs_le; unfold Rmax; destruct (Rle_dec 0 (fl (d - b))); rewrite U in *; lra.
rewrite (Rmax_left 0 w) by lra; apply near in D.
assert (top : d - b <= 2.05 * u * radius + 2.1 * eta) by (rewrite U in *; lra).
assert (low : 0 <= 2.05 * u * radius + 2.1 * eta) by (rewrite U; lra).
assert (capped : fl (d - b) <= fl (2.05 * u * radius + 2.1 * eta)) by (apply fl_mono; exact top).
assert (T := fl_error (2.05 * u * radius + 2.1 * eta)); rewrite (Rabs_pos_eq (2.05 * u * radius + _)) in T by exact low; apply near in T.
apply Rabs_le; unfold Rmax; destruct (Rle_dec 0 (fl (d - b))); rewrite U in *; lra.
Qed.

(* What the two ends are wrong by. *)
Lemma ends_close D : n * n <= D <= F * F -> D <= R2 -> let s := R2 - D in let low := low_fl radius d rho E in
  if Rle_dec top_fl 0 then Rabs s <= 1.2e-15 * R2 + 3e9 * eta
  else 0 <= low <= top_fl /\ top_fl <= square_fl /\ Rabs (s - closest s low top_fl) <= 1.2e-15 * R2 + 3e9 * eta.
Proof.
intros [nD DF] DR; cbv zeta; assert (U := u_value); assert (e := eta_pos); assert (small := eta_small); assert (l := least_small); assert (l0 := least_pos).
assert (r := R2_range radius radius_range); fold R2 in r; set (s := R2 - D); assert (s0 : 0 <= s) by (unfold s; lra).
assert (n0 : 0 <= n) by apply Rmax_l; assert (F0 : 0 <= F) by (unfold F; lra); assert (F8 : F <= 1e8) by (unfold F; lra).
assert (nR : n <= radius).
  destruct (Rle_lt_dec n radius) as [le | lt]; [exact le | exfalso].
  assert (radius * radius <= n * radius) by (apply Rmult_le_compat_r; lra); assert (n * radius < n * n) by (apply Rmult_lt_compat_l; lra); unfold R2 in *; lra.
assert (G := fl_error (radius * radius)); fold square_fl R2 in G; rewrite (Rabs_pos_eq R2) in G by lra; set (Rs := square_fl) in *.
assert (T := least_is 1e9 ltac:(lra)); assert (T1 : 1e9 * eta <= 1e-6 * (1e9 * least)) by lra.
assert (Rs0 : 0 <= Rs) by (apply fl_nonneg; fold R2; lra).
assert (D0 : 0 <= D) by (apply Rle_trans with (2 := nD); apply Rmult_le_pos; exact n0).
(* the high end *)
assert (nn : 0 <= n * radius <= R2) by (split; [apply Rmult_le_pos; lra | unfold R2; apply Rmult_le_compat_r; lra]).
assert (nn1 : 0 <= n * n) by (apply Rmult_le_pos; assumption).
assert (w0 := near_near); set (A := 3.1 * u * radius + 4 * eta).
assert (wA : Rabs (near_fl - n) <= A).
  apply Rle_trans with (1 := w0); assert (u * n <= u * radius) by (apply Rmult_le_compat_l; [rewrite U |]; lra); unfold A; lra.
assert (A0 : 0 <= A) by (unfold A; rewrite U; lra).
assert (er : eta * radius <= eta * 1e6) by (apply Rmult_le_compat_l; lra); assert (ee : eta * eta <= eta * 1) by (apply Rmult_le_compat_l; lra).
assert (N : Rabs (near_fl * near_fl - n * n) <= 6.3 * u * R2 + 1e8 * eta).
  replace (near_fl * near_fl - n * n) with ((near_fl - n) * (2 * n + (near_fl - n))) by ring; rewrite Rabs_mult.
  apply Rle_trans with (A * (2 * radius + A)).
    apply Rmult_le_compat; try apply Rabs_pos; [exact wA |]; apply Rle_trans with (1 := Rabs_triang _ _); rewrite (Rabs_pos_eq (2 * n)) by lra; lra.
  unfold A, R2 in *; rewrite U; lra.
assert (NN : Rabs (n * n) <= R2) by (rewrite Rabs_pos_eq; lra).
assert (N2 := fl_of _ _ _ _ N NN); set (near2 := fl (near_fl * near_fl)) in *.
assert (H1 : Rabs (Rs - near2 - (R2 - n * n)) <= 8.4 * u * R2 + 2e8 * eta).
  replace (_ - _) with ((Rs - R2) - (near2 - n * n)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp.
  rewrite U in *; lra.
assert (H2 : Rabs (R2 - n * n) <= R2) by (apply Rabs_le; lra).
assert (high : Rabs (top_fl - (R2 - n * n)) <= 1.1e-15 * R2 + 2e9 * eta).
  unfold top_fl; fold Rs near2; apply Rle_trans with (1 := fl_of _ _ _ _ H1 H2); rewrite U; lra.
apply near in high.
(* the low end *)
assert (FF0 : 0 <= F * F) by (apply Rmult_le_pos; assumption).
assert (t0 : 0 <= 4 * eta <= 1e-9) by lra.
assert (Ft : F * (4 * eta) <= 1e8 * (4 * eta)) by (apply Rmult_le_compat_r; lra).
assert (P := square_of _ _ (3.001 * u) (4 * eta) F0 ltac:(rewrite U; lra) t0 (farther_near d rho E d_range ltac:(lra) ltac:(lra))).
fold F in P; assert (FF : Rabs (F * F) <= F * F) by (rewrite Rabs_pos_eq; lra).
assert (P2 := fl_of _ _ _ _ P FF); set (far2 := fl (farther_fl d rho E * farther_fl d rho E)) in *.
assert (low : low_fl radius d rho E <= s + 1.2e-15 * R2 + 3e9 * eta).
  unfold low_fl; fold square_fl Rs far2; apply Rmax_lub; [lra |].
  assert (P3 : Rabs (far2 - F * F) <= 7.1 * u * (F * F) + 1e9 * eta) by (apply Rle_trans with (1 := P2); rewrite U; lra).
  apply near in G; apply near in P3; destruct (Rle_lt_dec (F * F) (1.01 * R2 + 1e10 * eta)) as [few | many].
    assert (L1 : Rabs (Rs - far2 - (R2 - F * F)) <= 8.2 * u * R2 + 2e9 * eta) by (apply Rabs_le; rewrite U in *; lra).
    assert (L2 : Rabs (R2 - F * F) <= R2 + 1e10 * eta) by (apply Rabs_le; lra).
    assert (L3 := fl_of _ _ _ _ L1 L2); apply near in L3; rewrite U in L3; unfold s; lra.
  assert (neg : Rs - far2 <= 0) by (rewrite U in *; lra).
  assert (fl (Rs - far2) <= 0) by (rewrite <- fl_zero; apply fl_mono; exact neg); lra.
destruct (Rle_dec top_fl 0) as [none | some]; [apply Rabs_le; unfold s in *; lra |].
assert (lo0 : 0 <= low_fl radius d rho E) by apply Rmax_l.
assert (nf0 : 0 <= near_fl) by apply Rmax_l.
assert (ordered : low_fl radius d rho E <= top_fl).
  unfold low_fl; apply Rmax_lub; [lra |]; unfold top_fl; apply fl_mono; fold square_fl Rs.
  assert (fl (near_fl * near_fl) <= fl (farther_fl d rho E * farther_fl d rho E)); [| lra].
  assert (b0 : 0 <= fl (fl (2 * rho) + E)) by (apply fl_nonneg; assert (0 <= fl (2 * rho)) by (apply fl_nonneg; lra); lra).
  assert (O : near_fl <= farther_fl d rho E).
    unfold near_fl, farther_fl; apply Rmax_lub; [apply fl_nonneg; lra | apply fl_mono; lra].
  apply fl_mono, Rmult_le_compat; lra.
assert (top : top_fl <= Rs).
  unfold top_fl; fold Rs; assert (c : 0 <= fl (near_fl * near_fl)) by (apply fl_nonneg, Rmult_le_pos; assumption).
  apply Rle_trans with (fl Rs); [apply fl_mono; lra | unfold Rs, square_fl; rewrite fl_twice; apply Rle_refl].
split; [lra | split; [exact top |]].
unfold closest; destruct (Rlt_dec s (low_fl radius d rho E)); [apply Rabs_le; lra |].
destruct (Rlt_dec top_fl s); apply Rabs_le; unfold s in *; lra.
Qed.

(* And what K is wrong by for it. *)
Lemma K_moved s a : 0 <= s <= R2 -> 0 <= a <= square_fl -> Rabs (s - a) <= 1.2e-15 * R2 + 3e9 * eta ->
  curvature.K q1 q2 R2 s <= curvature.K q1 q2 square_fl a + 1.2e-15 * R2 * (q1 * q2) * (3.2 + 6 * (sqrt q2 * R2)) + 1e-245.
Proof.
intros sin; assert (U := u_value); assert (e := eta_pos); assert (small := eta_small); assert (l := least_small); assert (l0 := least_pos); assert (s0 := proj1 sin).
assert (r := R2_range radius radius_range); fold R2 in r; assert (G := fl_error (radius * radius)); fold square_fl R2 in G; rewrite (Rabs_pos_eq R2) in G by lra; set (Rs := square_fl) in *.
assert (T := least_is 1e9 ltac:(lra)); assert (T1 : 1e9 * eta <= 1e-6 * (1e9 * least)) by lra; set (D := R2 - s); assert (DR : D <= R2) by (unfold D; lra); assert (D0 : 0 <= D) by (unfold D; lra).
assert (qq : 0 <= q1 * q2 <= 4e15) by (split; [apply Rmult_le_pos; lra | apply Rle_trans with (4 * 1e15); [apply Rmult_le_compat; lra | lra]]).
assert (root0 := sqrt_pos q2); assert (root : sqrt q2 <= 1e8).
  rewrite <- (sqrt_square 1e8) by lra; apply sqrt_le_1; lra.
set (Q := q1 * q2 * sqrt q2) in *; assert (Q0 : 0 <= Q <= 4e23).
  unfold Q; split; [apply Rmult_le_pos; lra | apply Rle_trans with (4e15 * 1e8); [apply Rmult_le_compat; lra | lra]].
intros ain gap; assert (M := f_moved q1 q2 q1_range q2_range s a s0 (proj1 ain)); assert (B := m_moved s a s0 (proj1 ain)).
assert (ma := m_range a (proj1 ain)); assert (ms := m_range s s0); set (w := 1.2e-15 * R2 + 3e9 * eta) in *; assert (wp : 0 <= w) by (unfold w; lra).
assert (M' : q1 * q2 / 2 * Rabs (s - a) <= q1 * q2 / 2 * w) by (apply Rmult_le_compat_l; lra).
fold Q in B; assert (B' : 1.5 * Q * Rabs (s - a) <= 1.5 * Q * w) by (apply Rmult_le_compat_l; lra).
apply near in M; apply near in B; apply near in gap; unfold curvature.K; fold (m s) (m a); fold D.
assert (c1 : D * m s <= D * (m a + 1.5 * Q * w)) by (apply Rmult_le_compat_l; lra).
assert (c2 : D * (1.5 * Q * w) <= R2 * (1.5 * Q * w)) by (apply Rmult_le_compat_r; [assert (0 <= Q * w) by (apply Rmult_le_pos; lra); lra | exact DR]).
assert (Da : D <= (Rs - a) + (w + u * R2 + eta)) by (apply near in G; unfold D in *; lra).
assert (c3 : D * m a <= ((Rs - a) + (w + u * R2 + eta)) * m a) by (apply Rmult_le_compat_r; lra).
assert (wu : 0 <= w + u * R2 + eta) by (assert (0 <= u * R2) by (apply Rmult_le_pos; [rewrite U |]; lra); lra).
assert (c4 : (w + u * R2 + eta) * m a <= (w + u * R2 + eta) * (q1 * q2 / 2)) by (apply Rmult_le_compat_l; lra).
assert (tq : q1 * q2 * eta <= 4e15 * eta) by (apply Rmult_le_compat_r; lra).
assert (QR : 0 <= Q * R2 <= 4e35) by (split; [apply Rmult_le_pos; lra | apply Rle_trans with (4e23 * 1e12); [apply Rmult_le_compat; lra | lra]]).
assert (tQ : Q * R2 * eta <= 4e35 * eta) by (apply Rmult_le_compat_r; lra).
assert (T3 : 1e46 * eta <= 1e-250).
    assert (T4 := least_is 1e30 ltac:(lra)); lra.
assert (qR : 0 <= q1 * q2 * R2) by (apply Rmult_le_pos; lra).
assert (id : 1.2e-15 * R2 * (q1 * q2) * (3.2 + 6 * (sqrt q2 * R2)) = 3.84e-15 * (q1 * q2 * R2) + 7.2e-15 * (Q * R2 * R2)) by (unfold Q; lra).
rewrite id; unfold w in *; rewrite U in *; lra.
Qed.

Variables peak hat : R.
Hypothesis is_peak : peak_of q1 q2 square_fl hat.
Hypothesis peak_range : 0 <= peak <= square_fl.
Hypothesis peak_high : curvature.K q1 q2 square_fl hat <= (1 + 1e-13) * curvature.K q1 q2 square_fl peak.

Theorem bend_max_from_distance D : n * n <= D <= F * F -> D <= R2 ->
  curvature.K q1 q2 R2 (R2 - D) <= bend_max peak + 1.2e-15 * R2 * (q1 * q2) * (3.2 + 6 * (sqrt q2 * R2)) + 1e-240.
Proof.
intros Din DR; assert (C := ends_close D Din DR); cbv zeta in C; assert (U := u_value); assert (e := eta_pos); assert (small := eta_small); assert (l := least_small).
assert (r := R2_range radius radius_range); fold R2 in r; assert (D0 : 0 <= D) by (apply Rle_trans with (2 := proj1 Din); apply Rle_0_sqr); set (s := R2 - D) in *.
assert (G := fl_error (radius * radius)); fold square_fl R2 in G; rewrite (Rabs_pos_eq R2) in G by lra; apply near in G; set (Rs := square_fl) in *.
assert (Rs0 : 0 <= Rs) by (apply fl_nonneg; fold R2; lra); assert (sin : 0 <= s <= R2) by (unfold s; lra).
unfold bend_max; destruct (Rle_dec top_fl 0) as [none | some].
  assert (M := K_moved s 0 sin ltac:(fold Rs; lra) ltac:(rewrite Rminus_0_r; exact C)); fold Rs in M.
  assert (f00 : f q1 q2 0 = 0) by (unfold f; rewrite !Rmult_0_r; unfold Rdiv; rewrite !Rmult_0_l; reflexivity).
  assert (m00 : m 0 = 0).
    unfold m; rewrite Rmax_left; [reflexivity |]; unfold f'; rewrite !Rmult_0_r, Ropp_0, exp_0; unfold Rdiv; rewrite !Rmult_0_l; assert (0 <= q1 * q2) by (apply Rmult_le_pos; lra); lra.
  unfold curvature.K at 2 in M; fold (m 0) in M; rewrite f00, m00 in M; lra.
destruct C as [ordered [top gap]]; assert (cin := closest_in s _ _ (proj2 ordered)).
assert (Rs13 : 0 <= Rs <= 1e13) by (rewrite U in G; lra); assert (root0 := sqrt_pos q2).
assert (st : sqrt q2 * Rs <= 151).
  assert (root : sqrt q2 <= 1e8) by (rewrite <- (sqrt_square 1e8) by lra; apply sqrt_le_1; lra).
  assert (sqrt q2 * Rs <= sqrt q2 * (R2 + u * R2 + eta)) by (apply Rmult_le_compat_l; lra).
  assert (sqrt q2 * eta <= 1e8 * eta) by (apply Rmult_le_compat_r; lra); fold R2 in steep; rewrite U in *; lra.
assert (M := bend_max_enough q1 q2 Rs q1_range q2_range Rs13 st far far_nonneg peak hat is_peak peak_range peak_high _ _ _ (proj1 ordered) cin top).
assert (A1 := K_moved s (closest s (low_fl radius d rho E) top_fl) sin (conj (Rle_trans _ _ _ (proj1 ordered) (proj1 cin)) (Rle_trans _ _ _ (proj2 cin) top)) gap).
fold Rs in A1 |- *; lra.
Qed.
End Ends.
