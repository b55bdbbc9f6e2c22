(* The slope of a weight as it is computed (crates/core/src/equations/link.rs: `link_of`; crates/core/src/controller/budget/curvature.rs: `slope`).

   In words. Every operation is rounded; u = 2^-53; 0 < q1 <= 4, 0 < q2 <= 1e15, and z = q2 s^2. For a slack s as it is stored, with z <= 690, f(s) and
   the slope - 2 f(s) of a link are wrong by at most (2.13 z + 23) u of themselves and 1e-270 (`f_error`, `link_slope_error`). The part with z is the
   exponential of an exponent that is rounded.

   `slope_from_positions`: from two positions to the slope of the link. What the slack is wrong by adds 9.3e-16 q1 q2 R^2, because no slope of f is
   steeper than q1 q2/2 (`f'_range`).

   `close x y r t` says that x is y but for r units u of y and t; `mul` is how that spreads through a rounded product. What the exponential does
   below -700 is left open here (`far`), but for its being at least 0. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded.
Import ExactIntervals.
Local Open Scope R_scope.

(* x is y but for r units u of itself and t. *)
Definition close x y r t := Rabs (x - y) <= r * u * Rabs y + t.

Lemma same x : close x x 0 0.
Proof. unfold close; rewrite Rminus_diag_eq, Rabs_R0 by lra; lra. Qed.

Lemma weaker x y r t r' t' : close x y r t -> r <= r' -> t <= t' -> close x y r' t'.
Proof.
unfold close; intros H hr ht; assert (U := u_pos); assert (P := Rabs_pos y).
assert (r * (u * Rabs y) <= r' * (u * Rabs y)) by (apply Rmult_le_compat_r; [apply Rmult_le_pos |]; lra); lra.
Qed.

Lemma mul x y r t a b p s Y B : close x y r t -> close a b p s ->
  0 <= r <= 4000 -> 0 <= p <= 4000 -> 0 <= t -> 0 <= s -> Rabs y <= Y -> Rabs b <= B -> close (fl (x * a)) (y * b) (r + p + 1.001) (1.01 * (t * B + s * Y + t * s) + eta).
Proof.
unfold close; intros H G hr hp ht hs hy hb; assert (U := u_pos); assert (U1 := u_value); assert (E := eta_pos).
assert (y0 := Rabs_pos y); assert (b0 := Rabs_pos b); set (Ay := Rabs y) in *; set (Ab := Rabs b) in *.
set (dx := Rabs (x - y)) in *; set (da := Rabs (a - b)) in *.
assert (x0 : 0 <= dx) by apply Rabs_pos; assert (a0 : 0 <= da) by apply Rabs_pos.
assert (D : Rabs (x * a - y * b) <= dx * Ab + Ay * da + dx * da).
  replace (x * a - y * b) with ((x - y) * b + y * (a - b) + (x - y) * (a - b)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); apply Rplus_le_compat; [| rewrite Rabs_mult; apply Rle_refl].
  apply Rle_trans with (1 := Rabs_triang _ _); rewrite !Rabs_mult; apply Rle_refl.
assert (yb : 0 <= Ay * Ab) by (apply Rmult_le_pos; assumption).
assert (ru : 0 <= r * u <= 1e-9) by (split; [apply Rmult_le_pos; lra | rewrite U1; lra]).
assert (pu : 0 <= p * u <= 1e-9) by (split; [apply Rmult_le_pos; lra | rewrite U1; lra]).
assert (d1 : dx * Ab <= r * u * (Ay * Ab) + t * Ab).
  apply Rle_trans with ((r * u * Ay + t) * Ab); [apply Rmult_le_compat_r; assumption | lra].
assert (d2 : Ay * da <= p * u * (Ay * Ab) + s * Ay).
  apply Rle_trans with (Ay * (p * u * Ab + s)); [apply Rmult_le_compat_l; assumption | lra].
assert (d3 : dx * da <= r * u * (p * u) * (Ay * Ab) + 1e-9 * (s * Ay) + 1e-9 * (t * Ab) + t * s).
  apply Rle_trans with ((r * u * Ay + t) * (p * u * Ab + s)); [apply Rmult_le_compat; assumption |].
  assert (r * u * (Ay * s) <= 1e-9 * (Ay * s)) by (apply Rmult_le_compat_r; [apply Rmult_le_pos; assumption | lra]).
  assert (p * u * (Ab * t) <= 1e-9 * (Ab * t)) by (apply Rmult_le_compat_r; [apply Rmult_le_pos; assumption | lra]).
  lra.
assert (rp : r * u * (p * u) <= 1e-4 * u).
  replace (r * u * (p * u)) with (r * (p * u) * u) by ring; apply Rmult_le_compat_r; [lra |].
  apply Rle_trans with (4000 * 1e-9); [apply Rmult_le_compat; lra | lra].
assert (d4 : r * u * (p * u) * (Ay * Ab) <= 1e-4 * u * (Ay * Ab)) by (apply Rmult_le_compat_r; assumption).
assert (tb : 0 <= t * Ab <= t * B) by (split; [apply Rmult_le_pos; assumption | apply Rmult_le_compat_l; assumption]).
assert (sy : 0 <= s * Ay <= s * Y) by (split; [apply Rmult_le_pos; assumption | apply Rmult_le_compat_l; assumption]).
assert (ts : 0 <= t * s) by (apply Rmult_le_pos; assumption).
assert (size : Rabs (y * b) <= Ay * Ab) by (rewrite Rabs_mult; apply Rle_refl).
set (total := (r + p + 1e-4) * u * (Ay * Ab) + 1.001 * (t * B + s * Y + t * s)).
assert (D' : Rabs (x * a - y * b) <= total) by (unfold total; lra).
apply Rle_trans with (1 := fl_of _ _ _ _ D' size); rewrite Rabs_mult; fold Ay Ab; unfold total.
assert (one : u * ((r + p + 1e-4) * (u * (Ay * Ab))) <= 1e-4 * (u * (Ay * Ab))).
  rewrite <- Rmult_assoc; apply Rmult_le_compat_r; [apply Rmult_le_pos; lra | rewrite U1; lra].
assert (two : u * (t * B + s * Y + t * s) <= 1e-9 * (t * B + s * Y + t * s)) by (apply Rmult_le_compat_r; [lra | rewrite U1; lra]).
assert (three : 0 <= u * (Ay * Ab)) by (apply Rmult_le_pos; lra).
lra.
Qed.

Lemma near_exp d : Rabs d <= 2e-13 -> Rabs (exp d - 1) <= 1.01 * Rabs d.
Proof.
intro D; destruct (Req_dec d 0) as [-> | ne]; [rewrite exp_0, Rminus_diag_eq, Rabs_R0 by lra; lra |].
apply Rabs_le_inv in D; assert (low := exp_ineq1_le d); assert (high := exp_ineq1_le (- d)).
assert (inv : exp d * exp (- d) = 1) by (rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
assert (pos := exp_pos d); assert (up : exp d * (1 - d) <= 1) by nra.
assert (cap : exp d <= 1.001) by nra.
destruct (Rle_lt_dec 0 d); [rewrite !Rabs_pos_eq by lra; nra | rewrite !Rabs_left by nra; nra].
Qed.

Section Slope.
Variables q1 q2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Variable far : R -> R.
Hypothesis far_nonneg : forall x, 0 <= far x.
Definition exp_code x := if Rle_dec (-700) x then exp_fl x else far x.
Definition tail_fl s := exp_code (exponent_fl q2 s).
Definition inverse_fl e := fl (1 / fl (1 + e)).
(* 2 q1 q2 e/(1 + e)^2 *)
Definition factor_fl e := fl (fl (fl (fl (fl (2 * q1) * q2) * e) * inverse_fl e) * inverse_fl e).
Definition f_fl s := fl (factor_fl (tail_fl s) * s).
Definition link_slope_fl s := let e := tail_fl s in
  fl (e * fl (fl (fl (fl (fl (- 4 * q1) * q2) * s) * inverse_fl e) * inverse_fl e)).

Section At.
Variable s : R.
Hypothesis s_range : 0 <= s <= 1e13.
Hypothesis z_range : q2 * (s * s) <= 690.
Let z := q2 * (s * s).
Let E := exp (- z).

Lemma z0 : 0 <= z. Proof. unfold z; apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]. Qed.
Lemma E_range : 0 < E <= 1.
Proof.
assert (Z := z0); split; [apply exp_pos |]; unfold E; rewrite <- exp_0.
destruct (Req_dec z 0) as [-> | ne]; [rewrite Ropp_0; lra | apply Rlt_le, exp_increasing; lra].
Qed.

Lemma exponent_near : Rabs (exponent_fl q2 s - - z) <= 2.1 * u * z + 1e-29.
Proof. apply exponent_error; lra. Qed.

Lemma tail_is : tail_fl s = exp_fl (exponent_fl q2 s).
Proof.
unfold tail_fl, exp_code; assert (X := exponent_near); apply near in X; assert (Z := z0); rewrite u_value in X.
destruct (Rle_dec _ _) as [_ | no]; [reflexivity | exfalso; apply no; unfold z in *; lra].
Qed.

Lemma tail_close : close (tail_fl s) E (2.13 * z + 2.6) 0.
Proof.
rewrite tail_is; unfold close; assert (Z := z0); assert (X := exponent_near); assert (U := u_value); assert (e0 := E_range).
set (x := exponent_fl q2 s) in *; assert (d0 : Rabs (x - - z) <= 2e-13) by (apply Rle_trans with (1 := X); rewrite U; unfold z in *; lra).
assert (x700 : -700 <= x <= 700) by (apply near in d0; unfold z in *; lra).
assert (F := exp_error x x700); set (d := x - - z) in *.
assert (xd : exp x = E * exp d) by (unfold E; rewrite <- exp_plus; f_equal; unfold d; ring).
assert (N := near_exp d d0); assert (D1 := Rle_trans _ _ _ N (Rmult_le_compat_l 1.01 _ _ ltac:(lra) X)).
assert (cap : exp d <= 1.001) by (apply near in N; lra).
rewrite xd in F; rewrite (Rabs_pos_eq E) by lra.
replace (exp_fl x - E) with ((exp_fl x - E * exp d) + E * (exp d - 1)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_mult, (Rabs_pos_eq E) by lra.
assert (p1 : E * Rabs (exp d - 1) <= E * (1.01 * (2.1 * u * z + 1e-29))) by (apply Rmult_le_compat_l; lra).
assert (p2 : 2.5 * u * (E * exp d) <= 2.5 * u * (E * 1.001)) by (apply Rmult_le_compat_l; [rewrite U; lra | apply Rmult_le_compat_l; lra]).
assert (zE : 0 <= E * z) by (apply Rmult_le_pos; lra).
rewrite U in *; lra.
Qed.

Lemma tail_abs : Rabs (tail_fl s - E) <= 3.7e-16.
Proof. rewrite tail_is; apply tail_of_weight; lra. Qed.

Lemma inverse_close : close (inverse_fl (tail_fl s)) (/ (1 + E)) 7 0.
Proof.
assert (T := tail_abs); set (e := tail_fl s) in *; assert (e0 := E_range); apply near in T; assert (U := u_value).
assert (s0 : Rabs (1 + e) <= 2.01) by (apply Rabs_le; lra).
assert (s1 := fl_abs _ _ s0); unfold inverse_fl; set (b := fl (1 + e)) in *.
assert (b1 : Rabs (b - (1 + E)) <= 6e-16) by (rewrite U in s1; apply near in s1; apply Rabs_le; lra).
assert (b2 := near _ _ _ b1); set (J := / (1 + E)).
assert (j0 : 0.5 <= J <= 1).
  unfold J; split; [apply Rmult_le_reg_r with (1 + E); [lra | rewrite Rinv_l; lra] | apply Rmult_le_reg_r with (1 + E); [lra | rewrite Rinv_l; lra]].
assert (i0 : 0 < / b <= 1.0001) by (split; [apply Rinv_0_lt_compat; lra | apply Rmult_le_reg_l with b; [lra | rewrite Rinv_r; lra]]).
assert (bj : Rabs (1 / b - J) <= 6e-16 * (1.0001 * J)).
  replace (1 / b - J) with ((1 + E - b) * (/ b * J)) by (unfold J; field; lra).
  rewrite Rabs_mult, (Rabs_pos_eq (/ b * J)) by (apply Rmult_le_pos; lra).
  apply Rmult_le_compat; [apply Rabs_pos | apply Rmult_le_pos; lra | rewrite Rabs_minus_sym; exact b1 | apply Rmult_le_compat_r; lra].
assert (jj : Rabs J <= J) by (rewrite Rabs_pos_eq; lra).
unfold close; rewrite (Rabs_pos_eq J) by lra.
apply Rle_trans with (1 := fl_of _ _ _ _ bj jj); assert (L := least_small); assert (S := eta_small); rewrite U; lra.
Qed.

Lemma J_range : 0 < / (1 + E) <= 1.
Proof.
assert (e0 := E_range); split; [apply Rinv_0_lt_compat; lra | apply Rmult_le_reg_r with (1 + E); [lra | rewrite Rinv_l; lra]].
Qed.

Lemma rates : 0 <= 2.13 * z + 2.6 <= 1480.
Proof. assert (Z := z0); unfold z in *; lra. Qed.

(* What is near 1 and 0 <= |y| <= Y for products of numbers that are not negative. *)
Lemma small_product a b A B : 0 <= a <= A -> 0 <= b <= B -> 0 <= a * b <= A * B.
Proof. intros; split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra. Qed.

Lemma factor_close : close (factor_fl (tail_fl s)) (2 * q1 * q2 * E * / (1 + E) * / (1 + E)) (2.13 * z + 21.9) (1e16 * eta).
Proof.
assert (e0 := E_range); assert (j0 := J_range); assert (T := tail_close); assert (I := inverse_close); assert (Rt := rates); assert (n0 := eta_pos).
set (e := tail_fl s) in *; set (J := / (1 + E)) in *; unfold factor_fl; fold e; set (inv := inverse_fl e) in *.
assert (Z := z0).
assert (a1 : 0 <= 2 * q1 <= 8) by lra.
assert (a2 := small_product _ _ _ _ a1 (conj (Rlt_le _ _ (proj1 q2_range)) (proj2 q2_range))).
assert (a3 := small_product _ _ _ _ a2 (conj (Rlt_le _ _ (proj1 e0)) (proj2 e0))).
assert (a4 := small_product _ _ _ _ a3 (conj (Rlt_le _ _ (proj1 j0)) (proj2 j0))).
assert (pos : forall a A, 0 <= a <= A -> Rabs a <= A) by (intros; rewrite Rabs_pos_eq; lra).
assert (m1 : close (fl (2 * q1)) (2 * q1) 1.001 eta).
  apply (weaker _ _ _ _ _ _ (mul 2 2 0 0 q1 q1 0 0 2 4 (same 2) (same q1) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (m2 : close (fl (fl (2 * q1) * q2)) (2 * q1 * q2) 2.002 (2e15 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ q2 q2 0 0 8 1e15 m1 (same q2) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (m3 : close (fl (fl (fl (2 * q1) * q2) * e)) (2 * q1 * q2 * E) (2.13 * z + 5.7) (3e15 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 8e15 1 m2 T ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (m4 : close (fl (fl (fl (fl (2 * q1) * q2) * e) * inv)) (2 * q1 * q2 * E * J) (2.13 * z + 13.8) (4e15 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 8e15 1 m3 I ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 8e15 1 m4 I ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
Qed.

Lemma f_is : 2 * q1 * q2 * E * / (1 + E) * / (1 + E) * s = f q1 q2 s.
Proof. unfold f; fold z; fold E; field; assert (e0 := E_range); lra. Qed.

Lemma tiny_is t : t <= 1e30 -> t * eta <= 1e-270.
Proof.
intro small; assert (S := eta_small); assert (n0 := eta_pos).
apply Rle_trans with (1e30 * (least / 1000000)).
  apply Rle_trans with (1e30 * eta); [apply Rmult_le_compat_r | apply Rmult_le_compat_l]; lra.
unfold least; apply Rmult_le_reg_r with (IZR (10 ^ 300)); [apply IZR_lt; reflexivity |].
unfold Rdiv; rewrite !Rmult_assoc, (Rmult_comm (/ 1000000)), <- Rmult_assoc, <- (Rmult_assoc (/ _)), Rinv_l by (apply not_0_IZR; discriminate); simpl; lra.
Qed.

Theorem link_slope_error : Rabs (link_slope_fl s - -2 * f q1 q2 s) <= (2.13 * z + 23) * u * (2 * f q1 q2 s) + 1e-270.
Proof.
assert (e0 := E_range); assert (j0 := J_range); assert (T := tail_close); assert (I := inverse_close); assert (Rt := rates); assert (n0 := eta_pos); assert (Z := z0).
unfold link_slope_fl; set (e := tail_fl s) in *; set (J := / (1 + E)) in *; set (inv := inverse_fl e) in *; cbv zeta.
assert (pos : forall a A, 0 <= a <= A -> Rabs a <= A) by (intros; rewrite Rabs_pos_eq; lra).
assert (q2a : Rabs q2 <= 1e15) by (apply pos; lra); assert (sa : Rabs s <= 1e13) by (apply pos; lra).
assert (Ja : Rabs J <= 1) by (apply pos; lra); assert (Ea : Rabs E <= 1) by (apply pos; lra).
assert (b1 : Rabs (-4 * q1) <= 16) by (apply Rabs_le; lra).
assert (b2 := product _ _ _ _ b1 q2a); assert (b3 := product _ _ _ _ b2 sa); assert (b4 := product _ _ _ _ b3 Ja); assert (b5 := product _ _ _ _ b4 Ja).
assert (m1 : close (fl (-4 * q1)) (-4 * q1) 1.001 eta).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 4 4 (same (-4)) (same q1) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply Rabs_le; lra) ltac:(apply Rabs_le; lra))); lra.
assert (m2 : close (fl (fl (-4 * q1) * q2)) (-4 * q1 * q2) 2.002 (2e15 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 16 1e15 m1 (same q2) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) b1 q2a)); lra.
assert (m3 : close (fl (fl (fl (-4 * q1) * q2) * s)) (-4 * q1 * q2 * s) 3.003 (3e28 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ (16 * 1e15) 1e13 m2 (same s) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) b2 sa)); lra.
assert (m4 : close (fl (fl (fl (fl (-4 * q1) * q2) * s) * inv)) (-4 * q1 * q2 * s * J) 11.004 (4e28 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ (16 * 1e15 * 1e13) 1 m3 I ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) b3 Ja)); lra.
assert (m5 : close (fl (fl (fl (fl (fl (-4 * q1) * q2) * s) * inv) * inv)) (-4 * q1 * q2 * s * J * J) 19.005 (5e28 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ (16 * 1e15 * 1e13 * 1) 1 m4 I ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) b4 Ja)); lra.
assert (M := mul _ _ _ _ _ _ _ _ 1 (16 * 1e15 * 1e13 * 1 * 1) T m5 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) Ea b5).
assert (is : E * (-4 * q1 * q2 * s * J * J) = -2 * f q1 q2 s) by (rewrite <- f_is; fold J; ring); rewrite is in M.
assert (f0 : 0 <= f q1 q2 s) by (apply f_nonneg; lra).
assert (W := weaker _ _ _ _ (2.13 * z + 23) 1e-270 M ltac:(lra)); unfold close in W.
rewrite (Rabs_left1 (-2 * f q1 q2 s)) in W by lra; replace (- (-2 * f q1 q2 s)) with (2 * f q1 q2 s) in W by ring.
apply W; apply Rle_trans with (1e30 * eta); [lra | apply tiny_is; lra].
Qed.

Theorem f_error : Rabs (f_fl s - f q1 q2 s) <= (2.13 * z + 23) * u * f q1 q2 s + 1e-270.
Proof.
assert (F := factor_close); assert (Rt := rates); assert (n0 := eta_pos); assert (e0 := E_range); assert (j0 := J_range); assert (Z := z0).
assert (a1 : 0 <= 2 * q1 <= 8) by lra.
assert (a2 := small_product _ _ _ _ a1 (conj (Rlt_le _ _ (proj1 q2_range)) (proj2 q2_range))).
assert (a3 := small_product _ _ _ _ a2 (conj (Rlt_le _ _ (proj1 e0)) (proj2 e0))).
assert (a4 := small_product _ _ _ _ a3 (conj (Rlt_le _ _ (proj1 j0)) (proj2 j0))).
assert (a5 := small_product _ _ _ _ a4 (conj (Rlt_le _ _ (proj1 j0)) (proj2 j0))).
assert (pos : forall a A, 0 <= a <= A -> Rabs a <= A) by (intros; rewrite Rabs_pos_eq; lra).
assert (M := mul _ _ _ _ s s 0 0 8e15 1e13 F (same s) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra)).
rewrite f_is in M; assert (f0 : 0 <= f q1 q2 s) by (apply f_nonneg; lra).
assert (W := weaker _ _ _ _ (2.13 * z + 23) 1e-270 M ltac:(lra)); unfold close in W; rewrite (Rabs_pos_eq (f q1 q2 s)) in W by exact f0.
apply W; apply Rle_trans with (1e30 * eta); [lra | apply tiny_is; lra].
Qed.
End At.

(* No slope of f is steeper than q1 q2/2. *)
Lemma f'_range s : 0 <= s -> Rabs (f' q1 q2 s) <= q1 * q2 / 2.
Proof.
intro s0; assert (qq : 0 <= q1 * q2) by (apply Rmult_le_pos; lra); apply Rabs_le; split.
  assert (r0 := sqrt_pos q2); assert (rr := sqrt_sqrt q2 ltac:(lra)).
  assert (is : - f' q1 q2 s = q1 * q2 * bend_shape (sqrt q2 * s)).
    assert (e0 := exp_pos (- ((sqrt q2 * s) * (sqrt q2 * s)))).
    assert (z1 : q2 * (s * s) = (sqrt q2 * s) * (sqrt q2 * s)) by (rewrite <- rr at 1; ring).
    assert (z2 : 2 * q2 * (s * s) = 2 * (sqrt q2 * s * (sqrt q2 * s))) by (rewrite <- z1; ring).
    unfold f', bend_shape; rewrite z2, z1; field; lra.
  assert (le : bend_shape (sqrt q2 * s) <= 0.459).
    assert (u0 : 0 <= sqrt q2 * s) by (apply Rmult_le_pos; lra).
    destruct (Rle_lt_dec (sqrt q2 * s) 4); [apply bend_near; lra | apply bend_far; lra].
  assert (q1 * q2 * bend_shape (sqrt q2 * s) <= q1 * q2 * 0.459) by (apply Rmult_le_compat_l; lra); lra.
rewrite f'_turn; set (e := exp (- (q2 * (s * s)))); assert (e0 : 0 < e) by apply exp_pos.
assert (turn0 : 0 <= turn q2 s).
  assert (H := @turn_mono q2 ltac:(lra) 0 s ltac:(lra)); unfold turn in H at 1; rewrite !Rmult_0_r, Rmult_0_l in H; unfold Rdiv in H; rewrite Rmult_0_l in H; exact H.
assert (quarter : 2 * q1 * q2 * e / ((1 + e) * (1 + e)) <= q1 * q2 / 2).
  apply Rmult_le_reg_r with ((1 + e) * (1 + e)); [apply Rmult_lt_0_compat; lra |].
  unfold Rdiv at 1; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by (apply Rgt_not_eq, Rmult_lt_0_compat; lra).
  assert (0 <= (1 - e) * (1 - e)) by apply Rle_0_sqr; assert (0 <= q1 * q2 * ((1 - e) * (1 - e))) by (apply Rmult_le_pos; lra); lra.
assert (front0 : 0 <= 2 * q1 * q2 * e / ((1 + e) * (1 + e))).
  apply Rmult_le_pos; [apply Rmult_le_pos; lra | apply Rlt_le, Rinv_0_lt_compat, Rmult_lt_0_compat; lra].
assert (2 * q1 * q2 * e / ((1 + e) * (1 + e)) * (1 - turn q2 s) <= 2 * q1 * q2 * e / ((1 + e) * (1 + e)) * 1) by (apply Rmult_le_compat_l; lra); lra.
Qed.

Lemma f_moved a b : 0 <= a -> 0 <= b -> Rabs (f q1 q2 a - f q1 q2 b) <= q1 * q2 / 2 * Rabs (a - b).
Proof.
assert (up : forall a b, 0 <= a -> a <= b -> Rabs (f q1 q2 b - f q1 q2 a) <= q1 * q2 / 2 * Rabs (b - a)).
  intros c d c0 cd; destruct (between q1 q2 cd) as [m [mid is]]; rewrite is, Rabs_mult.
  apply Rmult_le_compat_r; [apply Rabs_pos | apply f'_range; lra].
intros a0 b0; destruct (Rle_lt_dec a b) as [le | lt]; [rewrite Rabs_minus_sym, (Rabs_minus_sym a b); apply up; lra | apply up; lra].
Qed.

Section Positions.
Variables (k : nat) (x y : nat -> R) (radius : R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis radius_range : 0 <= radius <= 1e6.
Let R2 := radius * radius.
Let D := distance2 k x y.
Let s := slack_fl k x y radius.
Hypothesis z_range : q2 * (s * s) <= 690.
(* A pair out of range has no link; 0 stands for it. *)
Definition slope_fl := if Rlt_dec s 0 then 0 else link_slope_fl s.

Theorem slope_from_positions : Rabs (slope_fl - -2 * f q1 q2 (Rmax (R2 - D) 0)) <=
  (2.13 * (q2 * (s * s)) + 23) * u * (2 * f q1 q2 (Rmax s 0)) + 9.3e-16 * (q1 * q2 * R2) + 1e-260.
Proof.
assert (P := distance2_nonneg k x y); fold D in P; assert (r := R2_range radius radius_range); fold R2 in r.
assert (L := least_small); assert (l0 : 0 < least) by (unfold least; apply Rinv_0_lt_compat, IZR_lt; reflexivity).
assert (qq : 0 <= q1 * q2 <= 4e15) by (split; [apply Rmult_le_pos; lra | apply Rle_trans with (4 * 1e15); [apply Rmult_le_compat; lra | lra]]).
assert (QR : 0 <= q1 * q2 * R2) by (apply Rmult_le_pos; lra).
assert (f00 : f q1 q2 0 = 0) by (unfold f; rewrite !Rmult_0_r; unfold Rdiv; rewrite !Rmult_0_l; reflexivity).
assert (tiny : q1 * q2 * (3 * least) <= 1e-261).
  apply Rle_trans with (4e15 * (3 * least)); [apply Rmult_le_compat_r; lra |].
  unfold least; apply Rmult_le_reg_r with (IZR (10 ^ 300)); [apply IZR_lt; reflexivity |].
  rewrite !Rmult_assoc, Rinv_l by (apply not_0_IZR; discriminate); simpl; lra.
assert (zz : 0 <= q2 * (s * s)) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]); assert (U := u_pos).
assert (stored : Rabs (slope_fl - -2 * f q1 q2 (Rmax s 0)) <= (2.13 * (q2 * (s * s)) + 23) * u * (2 * f q1 q2 (Rmax s 0)) + 1e-270 \/ 1e13 < s).
  unfold slope_fl; destruct (Rlt_dec s 0) as [neg | nonneg].
    left; rewrite Rmax_right by lra; rewrite f00, !Rmult_0_r, Rminus_diag_eq, Rabs_R0 by lra; lra.
  destruct (Rle_lt_dec s 1e13) as [le | lt]; [left | right; exact lt].
  rewrite Rmax_left by lra; apply link_slope_error; [lra | exact z_range].
destruct (Rle_lt_dec D (R2 * (1 + 1e-14) + 3 * least)) as [few | many].
  assert (S := slack_error k x y radius k3 doubles radius_range few); fold R2 D s in S.
  destruct stored as [W | big]; [| apply near in S; lra].
  assert (M := f_moved (Rmax s 0) (Rmax (R2 - D) 0) (Rmax_r _ _) (Rmax_r _ _)).
  assert (clip : Rabs (Rmax s 0 - Rmax (R2 - D) 0) <= 9.2e-16 * R2 + 3 * least).
    apply near in S; apply Rabs_le; unfold Rmax; destruct (Rle_dec s 0); destruct (Rle_dec (R2 - D) 0); lra.
  assert (M' : q1 * q2 / 2 * Rabs (Rmax s 0 - Rmax (R2 - D) 0) <= q1 * q2 / 2 * (9.2e-16 * R2 + 3 * least)) by (apply Rmult_le_compat_l; lra).
  replace (slope_fl - -2 * f q1 q2 (Rmax (R2 - D) 0)) with
    ((slope_fl - -2 * f q1 q2 (Rmax s 0)) + -2 * (f q1 q2 (Rmax s 0) - f q1 q2 (Rmax (R2 - D) 0))) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); rewrite (Rabs_mult (-2)), (Rabs_left1 (-2)) by lra; lra.
assert (neg : s < 0).
  destruct (Rle_lt_dec 0 s) as [pos | neg]; [exfalso | exact neg].
  assert (O := out_of_range k x y radius k3 doubles radius_range (Rle_ge _ _ pos)); fold D R2 in O; lra.
destruct stored as [W | big]; [| lra].
rewrite (Rmax_right (R2 - D)) by (assert (0 <= R2 * 1e-14) by lra; lra); rewrite (Rmax_right s) in * by lra; lra.
Qed.
End Positions.
End Slope.
