(* kappa as it is computed is large enough (crates/core/src/controller/budget/curvature.rs: `bend_max`; docs/theory/weights.md: eq:curvature-bound).

   In words. kappa is K at the point of an interval of s closest to a stored peak, computed with every operation rounded, and raised by a factor
   1 + 1e-12. 0 < q1 <= 4, 0 < q2 <= 1e15, R^2 is taken as it is stored, at most 1e13, and sqrt(q2) R^2 <= 151, which holds of whatever `budget` chooses (150, and what is rounded of it).

   `bend_low`: K as it is computed at one stored s with q2 s^2 <= 690 is at least (1 - 8e-13) K(s), less 1e-255.
   `bend_max_enough`: if K at the stored peak is at least the largest K divided by 1 + 1e-13, K(s) is at most this kappa, and 1e-250, for every s between the two ends
   as they are stored. So the factor covers all rounding of kappa for given ends. That the stored peak is so is `stored_peak` in bend_peak_rounded.v.

   The steeper a weight, the more of the 1e-12 is used up: where K begins to have a second term that term is a difference of numbers near 1, times R^2. For
   weights that are steeper than any that is chosen the factor is not proved to be enough. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded slope_max_rounded.
Import ExactIntervals.
Local Open Scope R_scope.

(* What is rounded from below. *)
Lemma fl_low x : 0 <= x -> (1 - u) * x - eta <= fl x.
Proof. intro x0; assert (F := fl_error x); rewrite (Rabs_pos_eq x) in F by exact x0; apply near in F; lra. Qed.

Lemma product_low a b x y d e : 0 <= a -> 0 <= b -> 0 <= x -> 0 <= y -> 0 <= d -> 0 <= e -> x - d <= a -> y - e <= b -> x * y - d * y - e * x <= a * b.
Proof.
intros a0 b0 x0 y0 d0 e0 ax by_; assert (ab : 0 <= a * b) by (apply Rmult_le_pos; assumption).
assert (dy : 0 <= d * y) by (apply Rmult_le_pos; assumption); assert (ex : 0 <= e * x) by (apply Rmult_le_pos; assumption).
destruct (Rle_lt_dec x d) as [xd | xd].
  assert (x * y <= d * y) by (apply Rmult_le_compat_r; assumption); lra.
destruct (Rle_lt_dec y e) as [ye | ye].
  assert (x * y <= x * e) by (apply Rmult_le_compat_l; assumption); lra.
assert ((x - d) * (y - e) <= a * b) by (apply Rmult_le_compat; lra).
assert (0 <= d * e) by (apply Rmult_le_pos; assumption); lra.
Qed.

Section Bend.
Variables q1 q2 R2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Hypothesis R2_range : 0 <= R2 <= 1e13.
Hypothesis steep : sqrt q2 * R2 <= 151.
Variable far : R -> R.
Hypothesis far_nonneg : forall x, 0 <= far x.
Let K := curvature.K q1 q2 R2.

Definition turn_fl s := let e := tail_fl q2 far s in
  fl (fl (fl (2 * fl (fl (q2 * s) * s)) * fl (1 - e)) * inverse_fl e).
Definition bend_fl s := let e := tail_fl q2 far s in
  fl (fl (2 * factor_fl q1 q2 e) * fl (s + fl (fl (2 * fl (R2 - s)) * Rmax (fl (turn_fl s - 1)) 0))).
Definition bend_max_fl peak lo hi := fl (raise * bend_fl (closest peak lo hi)).

Section At.
Variable s : R.
Hypothesis s_range : 0 <= s <= R2.
Let z := q2 * (s * s).
Let E := exp (- z).
Let J := / (1 + E).
Let front := 2 * q1 * q2 * E * J * J.
Let T := turn q2 s.
Let W := R2 - s.

Lemma K_is : K s = 2 * front * (s + 2 * W * Rmax 0 (T - 1)).
Proof.
unfold K, curvature.K; rewrite f'_turn; fold T z E.
assert (e0 : 0 < E) by apply exp_pos; assert (is : 2 * q1 * q2 * E / ((1 + E) * (1 + E)) = front) by (unfold front, J; field; lra).
assert (front0 : 0 <= front).
  assert (0 < J) by (apply Rinv_0_lt_compat; lra); unfold front; repeat apply Rmult_le_pos; lra.
rewrite is; replace (- (front * (1 - T))) with (front * (T - 1)) by ring.
assert (fs : f q1 q2 s = front * s) by (unfold f; fold z E; unfold front, J; field; lra).
rewrite fs; destruct (Rle_lt_dec 0 (T - 1)) as [up | down].
  rewrite (Rmax_right 0 (T - 1)) by lra; rewrite (Rmax_right 0 (front * (T - 1))) by (apply Rmult_le_pos; lra); unfold W; ring.
assert (0 <= front * (1 - T)) by (apply Rmult_le_pos; lra).
rewrite (Rmax_left 0 (T - 1)) by lra; rewrite (Rmax_left 0 (front * (T - 1))) by lra; ring.
Qed.

Hypothesis z_range : z <= 690.
Lemma s13 : 0 <= s <= 1e13. Proof. lra. Qed.

Lemma after_peak : 1 < T -> 1.04 <= z /\ 0 < s /\ W <= 147.3 * s.
Proof.
intro up; assert (q2_pos : 0 < q2) by lra; destruct (steepest q2_pos) as [star [star0 [turns Z]]]; unfold steepest_z in Z; apply near in Z.
assert (ss : star <= s).
  destruct (Rle_lt_dec star s) as [le | lt]; [exact le | exfalso].
  assert (m := @turn_mono q2 q2_pos s star ltac:(lra)); rewrite turns in m; fold T in m; lra.
assert (sq : star * star <= s * s) by (apply Rmult_le_compat; lra).
assert (z1 : 1.04 <= z) by (unfold z; apply Rle_trans with (q2 * (star * star)); [lra | apply Rmult_le_compat_l; lra]).
assert (s0 : 0 < s) by (destruct (Req_dec s 0) as [zero | ne]; [unfold z in z1; rewrite zero in z1; lra | lra]).
split; [exact z1 | split; [exact s0 |]].
assert (r0 := sqrt_pos q2); assert (rr := sqrt_sqrt q2 ltac:(lra)); set (r := sqrt q2) in *.
assert (rs : 1.0195 <= r * s).
  destruct (Rle_lt_dec 1.0195 (r * s)) as [le | lt]; [exact le | exfalso].
  assert (p0 : 0 <= r * s) by (apply Rmult_le_pos; lra).
  assert ((r * s) * (r * s) <= 1.0195 * 1.0195) by (apply Rmult_le_compat; lra).
  assert (zz : z = (r * s) * (r * s)) by (unfold z; rewrite <- rr; ring); lra.
apply Rmult_le_reg_l with r; [destruct r0 as [pos | zero]; [exact pos | rewrite <- zero in rs; lra] |].
unfold W; assert (0 <= r * s) by (apply Rmult_le_pos; lra); lra.
Qed.

Lemma turn_near : 1 < T -> Rabs (turn_fl s - T) <= 16.4 * u * T.
Proof.
intro up; destruct (after_peak up) as [z1 [s0 _]]; assert (n0 := eta_pos).
assert (e0 := E_range q2 q2_range s s13); fold z in e0; fold E in e0; assert (Tc := tail_close q2 q2_range far s s13 z_range); fold z in Tc; fold E in Tc.
assert (I := inverse_close q2 q2_range far s s13 z_range); fold z in I; fold E in I; fold J in I.
assert (j0 := J_range q2 q2_range s s13); fold z in j0; fold E in j0; fold J in j0.
unfold turn_fl; set (e := tail_fl q2 far s) in *; cbv zeta; set (inv := inverse_fl e) in *; assert (U := u_value).
assert (E1 : E <= 0.354).
  apply Rle_trans with (exp (-1.04)); [| interval with (i_prec 60)].
  unfold E; destruct (Rle_lt_or_eq_dec _ _ z1) as [lt | eq]; [apply Rlt_le, exp_increasing; lra | apply Req_le; f_equal; lra].
assert (zE : z * E <= 0.37) by (apply (falls_fast q2 s); lra).
assert (eE : Rabs (e - E) <= 1.72 * u).
  unfold close in Tc; rewrite (Rabs_pos_eq E) in Tc by lra; apply Rle_trans with (1 := Tc); rewrite U; lra.
assert (small := eta_small); assert (l := least_small).
assert (c1 : close (fl (1 - e)) (1 - E) 4.3 0).
  unfold close; rewrite (Rabs_pos_eq (1 - E)) by lra.
  assert (a : Rabs (1 - e - (1 - E)) <= 1.72 * u) by (replace (_ - _) with (- (e - E)) by ring; rewrite Rabs_Ropp; exact eE).
  assert (b : Rabs (1 - E) <= 1 - E) by (rewrite Rabs_pos_eq; lra).
  apply Rle_trans with (1 := fl_of _ _ _ _ a b); rewrite U; lra.
assert (pos : forall a A, 0 <= a <= A -> Rabs a <= A) by (intros; rewrite Rabs_pos_eq; lra).
assert (b1 := small_product q2 s 1e15 1e13 ltac:(lra) ltac:(lra)); assert (b2 : 0 <= q2 * s * s <= 690) by (unfold z in *; lra).
assert (m1 : close (fl (q2 * s)) (q2 * s) 1.001 eta).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 1e15 1e13 (same q2) (same s) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (m2 : close (fl (fl (q2 * s) * s)) (q2 * s * s) 2.002 (2e13 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ (1e15 * 1e13) 1e13 m1 (same s) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (m3 : close (fl (2 * fl (fl (q2 * s) * s))) (2 * (q2 * s * s)) 3.003 (5e13 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 2 690 (same 2) m2 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (m4 : close (fl (fl (2 * fl (fl (q2 * s) * s)) * fl (1 - e))) (2 * (q2 * s * s) * (1 - E)) 8.304 (6e13 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 1380 1 m3 c1 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (b3 := small_product (2 * (q2 * s * s)) (1 - E) 1380 1 ltac:(lra) ltac:(lra)).
assert (m5 : close (fl (fl (fl (2 * fl (fl (q2 * s) * s)) * fl (1 - e)) * inv)) (2 * (q2 * s * s) * (1 - E) * J) 16.305 (7e13 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ (1380 * 1) 1 m4 I ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (is : 2 * (q2 * s * s) * (1 - E) * J = T) by (unfold T, turn; fold z; fold E; unfold J, Rdiv; ring).
rewrite is in m5; unfold close in m5; rewrite (Rabs_pos_eq T) in m5 by lra.
assert (tiny := tiny_is 7e13 ltac:(lra)); apply Rle_trans with (1 := m5); rewrite U; lra.
Qed.

Lemma T_range : 0 <= T <= 1380.
Proof.
assert (q2_pos : 0 < q2) by lra; assert (th := @tanh_range q2 q2_pos s (proj1 s_range)); assert (is := T_tanh q2 s); cbv beta in is; fold T in is.
assert (z0' : 0 <= z) by (unfold z; apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
rewrite is; replace (2 * q2 * (s * s)) with (2 * z) by (unfold z; ring); split; [apply Rmult_le_pos; lra |].
apply Rle_trans with (2 * z * 1); [apply Rmult_le_compat_l; lra | lra].
Qed.

(* The bracket of K: s + 2 (R^2 - s) max(0, T - 1). *)
Let A := s + 2 * W * Rmax 0 (T - 1).
Definition bracket_fl := fl (s + fl (fl (2 * fl (R2 - s)) * Rmax (fl (turn_fl s - 1)) 0)).

Lemma bracket_low : (1 - 5.8e-13) * A - 1e5 * eta <= bracket_fl.
Proof.
assert (U := u_value); assert (n0 := eta_pos); assert (W0 : 0 <= W) by (unfold W; lra); assert (t0 := T_range).
assert (small := eta_small); assert (l := least_small).
set (tau := Rmax (fl (turn_fl s - 1)) 0); assert (tau0 : 0 <= tau) by apply Rmax_r.
assert (Wl := fl_low W W0); set (Wf := fl W) in *; assert (Wf0 : 0 <= Wf) by (apply fl_nonneg; exact W0).
assert (d0 := fl_low (2 * Wf) ltac:(lra)); set (d := fl (2 * Wf)) in *; assert (d1 : 0 <= d) by (apply fl_nonneg; lra).
assert (dtau : 0 <= d * tau) by (apply Rmult_le_pos; assumption).
assert (p0 := fl_low (d * tau) dtau); set (p := fl (d * tau)) in *; assert (p1 : 0 <= p) by (apply fl_nonneg; exact dtau).
assert (b0 := fl_low (s + p) ltac:(lra)); unfold bracket_fl; fold W Wf d tau p.
destruct (Rle_lt_dec T 1) as [low | up].
  assert (is : A = s) by (unfold A; rewrite Rmax_left by lra; ring); rewrite is, U in *; lra.
destruct (after_peak up) as [z1 [s0 Ws]]; assert (N := turn_near up).
set (t := T - 1) in *; assert (is : A = s + 2 * W * t) by (unfold A; rewrite Rmax_right by (unfold t; lra); reflexivity).
assert (tl : t - 17.5 * u * T <= tau).
  assert (a : Rabs (turn_fl s - 1 - t) <= 16.4 * u * T) by (unfold t; replace (_ - _) with (turn_fl s - T) by ring; exact N).
  assert (b : Rabs t <= T) by (unfold t; rewrite Rabs_pos_eq; lra).
  assert (c := fl_of _ _ _ _ a b); apply near in c; apply Rle_trans with (2 := Rmax_l _ _); rewrite U in *; lra.
assert (dl : 2 * W - (4.01 * u * W + 4 * eta) <= d) by (rewrite U in *; lra).
assert (t00 : 0 <= t) by (unfold t; lra); assert (wt : 0 <= W * t) by (apply Rmult_le_pos; lra).
assert (P := product_low d tau (2 * W) t (4.01 * u * W + 4 * eta) (17.5 * u * T) d1 tau0 ltac:(lra) t00 ltac:(rewrite U; lra) ltac:(rewrite U; lra) dl tl).
assert (et : eta * t <= eta * 1380) by (apply Rmult_le_compat_l; unfold t; lra).
assert (WT : W * T <= 147.3 * s + W * t) by (unfold t in *; lra).
rewrite is.
assert (WT' : 35 * u * (W * T) <= 35 * u * (147.3 * s + W * t)) by (apply Rmult_le_compat_l; [rewrite U |]; lra).
rewrite U in *; lra.
Qed.

Theorem bend_low : (1 - 8e-13) * K s - 1e-255 <= bend_fl s.
Proof.
assert (U := u_value); assert (n0 := eta_pos); assert (B := bracket_low); assert (t0 := T_range).
assert (F := factor_close q1 q2 q1_range q2_range far s s13 z_range); fold z in F; fold E in F; fold J in F; fold front in F.
assert (e0 := E_range q2 q2_range s s13); fold z in e0; fold E in e0; assert (j0 := J_range q2 q2_range s s13); fold z in j0; fold E in j0; fold J in j0.
assert (f0 : 0 <= front <= 8e15).
  assert (a1 := small_product (2 * q1) q2 8 1e15 ltac:(lra) ltac:(lra)); assert (a2 := small_product _ E _ 1 a1 ltac:(lra)).
  assert (a3 := small_product _ J _ 1 a2 ltac:(lra)); assert (a4 := small_product _ J _ 1 a3 ltac:(lra)); unfold front; lra.
assert (W0 : 0 <= W <= 1e13) by (unfold W; lra).
assert (A0 : 0 <= A <= 1e17).
  assert (m0 : 0 <= Rmax 0 (T - 1) <= 1380) by (split; [apply Rmax_l | apply Rmax_lub; lra]).
  assert (a1 := small_product (2 * W) _ 2e13 1380 ltac:(lra) m0); unfold A; lra.
unfold close in F; rewrite (Rabs_pos_eq front) in F by lra; apply near in F.
rewrite K_is; fold A; unfold bend_fl; cbv zeta; fold bracket_fl.
set (g := factor_fl q1 q2 (tail_fl q2 far s)) in *.
assert (s0 : 0 <= s) by lra; assert (te := tail_nonneg q2 q2_range far far_nonneg s s0); assert (ie := inverse_nonneg _ te).
assert (g0 : 0 <= g).
  assert (p : forall a b, 0 <= a -> 0 <= b -> 0 <= fl (a * b)) by (intros; apply fl_nonneg, Rmult_le_pos; assumption).
  unfold g, factor_fl; repeat (apply p; try assumption); lra.
assert (rate : (2.13 * z + 21.9) * u * front <= 1.67e-13 * front) by (apply Rmult_le_compat_r; [lra | rewrite U; lra]).
assert (gl : front - (1.67e-13 * front + 1e16 * eta) <= g) by lra.
assert (h0 := fl_low (2 * g) ltac:(lra)); set (h := fl (2 * g)) in *; assert (h1 : 0 <= h) by (apply fl_nonneg; lra).
assert (b1 : 0 <= bracket_fl).
  unfold bracket_fl; apply fl_nonneg; assert (0 <= fl (fl (2 * fl (R2 - s)) * Rmax (fl (turn_fl s - 1)) 0)); [| lra].
  apply fl_nonneg, Rmult_le_pos; [apply fl_nonneg; assert (0 <= fl (R2 - s)) by (apply fl_nonneg; lra); lra | apply Rmax_r].
assert (small := eta_small); assert (l := least_small).
assert (hl : 2 * front - (3.4e-13 * front + 3e16 * eta) <= h) by (rewrite U in *; lra).
assert (P := product_low h bracket_fl (2 * front) A (3.4e-13 * front + 3e16 * eta) (5.8e-13 * A + 1e5 * eta) h1 b1 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) hl ltac:(lra)).
assert (hb : 0 <= h * bracket_fl) by (apply Rmult_le_pos; assumption).
assert (R := fl_low _ hb); assert (fA : 0 <= front * A) by (apply Rmult_le_pos; lra).
assert (eA : eta * A <= eta * 1e17) by (apply Rmult_le_compat_l; lra); assert (ef : eta * front <= eta * 8e15) by (apply Rmult_le_compat_l; lra).
assert (T1 := least_is 1e30 ltac:(lra)); assert (T2 : 1e34 * eta <= 1e-258) by lra.
rewrite U in R; lra.
Qed.
End At.

Lemma K_nonneg s : 0 <= s <= R2 -> 0 <= K s.
Proof.
intro sin; assert (f0 : 0 <= f q1 q2 s) by (apply f_nonneg; lra).
unfold K, curvature.K; assert (0 <= (R2 - s) * Rmax 0 (- f' q1 q2 s)) by (apply Rmult_le_pos; [lra | apply Rmax_l]); lra.
Qed.

(* Far inside, K is as good as 0. *)
Lemma K_far s : 0 <= s <= R2 -> 690 < q2 * (s * s) -> K s <= 1e-265.
Proof.
intros sin deep; rewrite K_is by exact sin; set (z := q2 * (s * s)) in *; set (e := exp (- z)); assert (e0 : 0 < e) by apply exp_pos.
assert (e1 : e <= 1e-299).
  apply Rle_trans with (exp (-690)); [apply Rlt_le, exp_increasing; lra | interval with (i_prec 60)].
assert (ze : z * e <= 690e-299).
  assert (split : e * exp (z - 690) = exp (-690)) by (unfold e; rewrite <- exp_plus; f_equal; lra).
  assert (H := exp_ineq1_le (z - 690)); assert (b : exp (-690) <= 1e-299) by interval with (i_prec 60).
  assert (e * z <= e * (690 * exp (z - 690))) by (apply Rmult_le_compat_l; lra); lra.
set (J := / (1 + e)); assert (j0 : 0 <= J <= 1).
  unfold J; split; [apply Rlt_le, Rinv_0_lt_compat; lra | rewrite <- Rinv_1; apply Rinv_le_contravar; lra].
assert (q2_pos : 0 < q2) by lra; assert (th := @tanh_range q2 q2_pos s (proj1 sin)); assert (is := T_tanh q2 s); cbv beta in is.
assert (T0 : Rmax 0 (turn q2 s - 1) <= 2 * z).
  apply Rmax_lub; [lra |]; rewrite is; replace (2 * q2 * (s * s)) with (2 * z) by (unfold z; ring).
  assert (2 * z * tanh' q2 s <= 2 * z * 1) by (apply Rmult_le_compat_l; lra); lra.
assert (m0 : 0 <= Rmax 0 (turn q2 s - 1)) by apply Rmax_l.
assert (A : 0 <= s + 2 * (R2 - s) * Rmax 0 (turn q2 s - 1) <= 4e13 * (1 + z)).
  assert (a1 := small_product (2 * (R2 - s)) _ 2e13 (2 * z) ltac:(lra) (conj m0 T0)); lra.
assert (c1 := small_product (2 * q1) q2 8 1e15 ltac:(lra) ltac:(lra)); assert (jj := small_product J J 1 1 j0 j0).
assert (c2 := small_product _ _ _ _ c1 jj); set (c := 2 * q1 * q2 * (J * J)) in *.
set (b := s + 2 * (R2 - s) * Rmax 0 (turn q2 s - 1)) in *.
replace (2 * (2 * q1 * q2 * e * J * J) * b) with (2 * c * (e * b)) by (unfold c; ring).
assert (eb : 0 <= e * b <= 4e13 * 1000e-299).
  split; [apply Rmult_le_pos; lra |]; assert (e * b <= e * (4e13 * (1 + z))) by (apply Rmult_le_compat_l; lra); lra.
assert (d := small_product (2 * c) (e * b) 16e15 _ ltac:(lra) eb); lra.
Qed.

Lemma bend_nonneg q : 0 <= q <= R2 -> 0 <= bend_fl q.
Proof.
intro qin; assert (te := tail_nonneg q2 q2_range far far_nonneg q (proj1 qin)); assert (ie := inverse_nonneg _ te).
assert (pr : forall a b, 0 <= a -> 0 <= b -> 0 <= fl (a * b)) by (intros; apply fl_nonneg, Rmult_le_pos; assumption).
assert (g0 : 0 <= factor_fl q1 q2 (tail_fl q2 far q)) by (unfold factor_fl; repeat (apply pr; try assumption); lra).
unfold bend_fl; cbv zeta; apply pr; [apply pr; lra |]; apply fl_nonneg.
assert (0 <= fl (fl (2 * fl (R2 - q)) * Rmax (fl (turn_fl q - 1)) 0)); [| lra].
apply pr; [apply pr; [lra | apply fl_nonneg; lra] | apply Rmax_r].
Qed.

Variables peak hat : R.
Hypothesis is_peak : peak_of q1 q2 R2 hat.
Hypothesis hat_range : 0 <= hat <= R2.
Hypothesis peak_range : 0 <= peak <= R2.
Hypothesis peak_high : K hat <= (1 + 1e-13) * K peak.

Theorem bend_max_room lo hi s : 0 <= lo -> lo <= s <= hi -> hi <= R2 -> (1 + 9e-14) * K s <= bend_max_fl peak lo hi + 1e-250.
Proof.
intros lo0 sin hiR; assert (le : lo <= hi) by lra; assert (M := largest_bend is_peak lo0 hiR sin); fold K in M.
rewrite <- closest_is in M by exact le; set (p := closest hat lo hi) in *.
assert (pin := closest_in hat lo hi le); fold p in pin; assert (qin := closest_in peak lo hi le); set (q := closest peak lo hi) in *.
destruct is_peak as [up down]; fold K in up, down.
assert (kept : K p <= (1 + 1e-13) * K q).
  assert (Kq := K_nonneg q ltac:(lra)).
  assert (top : K p <= K hat) by (destruct (Rle_lt_dec p hat); [apply up | apply down]; lra).
  assert (pq : p = q \/ K peak <= K q).
    unfold p, q, closest in *; destruct (Rlt_dec hat lo); destruct (Rlt_dec peak lo); try (left; reflexivity);
      destruct (Rlt_dec hi hat); destruct (Rlt_dec hi peak); try (left; reflexivity); right; try apply Rle_refl; first [apply up; lra | apply down; lra].
  destruct pq as [-> | more]; lra.
assert (rr := raise_range); assert (U := u_value); assert (Kq := K_nonneg q ltac:(lra)).
assert (b0 := bend_nonneg q ltac:(lra)).
assert (L0 : 0 <= raise * bend_fl q) by (apply Rmult_le_pos; lra); unfold bend_max_fl; fold q.
destruct (Rle_lt_dec (q2 * (q * q)) 690) as [near_z | far_z].
  assert (B := bend_low q ltac:(lra) near_z); assert (F := fl_low _ L0).
  assert (raised : (1 + 9.99e-13) * bend_fl q <= raise * bend_fl q) by (apply Rmult_le_compat_r; lra).
  assert (n := eta_small); assert (l := least_is 1 ltac:(lra)); rewrite U in F; lra.
assert (L := fl_nonneg _ L0); assert (tiny := K_far q ltac:(lra) far_z); lra.
Qed.

Theorem bend_max_enough lo hi s : 0 <= lo -> lo <= s <= hi -> hi <= R2 -> K s <= bend_max_fl peak lo hi + 1e-250.
Proof. intros lo0 sin hiR; assert (H := bend_max_room lo hi s lo0 sin hiR); assert (P := K_nonneg s ltac:(lra)); lra. Qed.
End Bend.
