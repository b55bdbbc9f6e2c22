(* The rows of `links` as they are formed, asked and obeyed in doubles (crates/core/src/controller/links/rows.rs; docs/theory/links.md: eq:held, eq:near, thm:held).

   In words. Two robots sense their offset r = x - y exactly but for its subtraction, which is rounded. Each forms its row from it with every operation rounded: the squared distance, R^2, the
   bound, the factor of `Row::new`. `Row::holds` says yes of its displacement v, of length at most rho, and it moves by a part of m, which is v but for 3 u of each coordinate and 1e-300: that is
   what the quotient by the length of a tick and the cut to the box may change. D is the real squared distance, u = 2^-53, at most three dimensions. R is the R_h that is
   held, and at least a millimetre; D is at most (A R)^2 with A = 1.001.

   `held_row_real`: (held) holds in real numbers up to e = 3.8e-16 R^2 + 5.7e-15 (R rho + rho^2) + 1e-260.
   `held_tick_rounded`: whatever parts of both moves are done, the squared distance is then at most D + gamma (R^2 - D)^+ + 4 e, so at most max(D, R^2) + 4 e.
   `held_step_rounded`: at the end of a tick the same is true of the positions as they are stored, with 2.41e-15 S R + 2e-30 S^2 + 1e-270 more, where no coordinate is larger than S.
   `held_within_hair`: why R_h is a billionth below R. A link that is held at R_h with rho <= R_h/50 and S <= 10 R_h is not longer than R after any number of ticks up to 70,000, and 35,000 if it
   began half a hair beyond R_h. Rows do not bring back what rounding adds beyond R_h, so no better bound follows from the rows alone. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Closeranks Require Import exponential link_rounded slope_max_rounded moves_rounded rounding row_formed.
Local Open Scope R_scope.

(* One end: its row, its displacement v, its move m. *)
Section OneEnd.
Variables (k : nat) (x y : nat -> R) (radius gamma rho scale : R) (v m : nat -> R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis radius_range : 1e-3 <= radius <= 1e6.
Hypothesis gamma_range : 0 < gamma <= 1.
Hypothesis rho_range : 0 < rho <= 1e6.
Let R2 := radius * radius.
Let r := offset x y.
Let D := distance2 k x y.
Hypothesis in_sight : D <= 1.002 * R2.
Hypothesis v_short : square k v <= rho * rho.
Hypothesis v_small : forall d, Rabs (v d) <= 1e9.
Hypothesis made_of_v : forall d, Rabs (m d - v d) <= 3 * u * Rabs (v d) + least.

(* 0.25 * gamma * larger(R^2 - D, 0) *)
Definition held_bound_fl := fl (fl (/ 4 * gamma) * Rmax (slack_fl k x y radius) 0).
Definition held_row_fl := formed_holds k (offset_fl x y) v 1 held_bound_fl scale.
Hypothesis scale_range : 1 <= scale * largest (offset_fl x y) 1 k < 2.
Hypothesis largest_small : largest (offset_fl x y) 1 k <= 1e9.
Hypothesis offset_small : forall d, Rabs (r d) <= 1e9.

Definition held_wrong := 3.8e-16 * R2 + 5.7e-15 * (radius * rho + rho * rho) + 1e-260.

Lemma R2_is : 1e-6 <= R2 <= 1e12.
Proof. unfold R2; split; [apply Rle_trans with (1e-3 * 1e-3) | apply Rle_trans with (1e6 * 1e6)]; try lra; apply Rmult_le_compat; lra. Qed.

Lemma held_bound_enough : held_bound_fl <= gamma / 4 * Rmax (R2 - D) 0 + 2.9e-16 * R2 /\ 0 <= held_bound_fl <= 0.26 * R2.
Proof.
assert (U := u_value); assert (n0 := eta_pos); assert (ns := eta_small); assert (l := least_small); assert (l0 := least_pos); assert (rr := R2_is).
assert (P := distance2_nonneg k x y); fold D in P; assert (radius0 : 0 <= radius <= 1e6) by lra.
assert (s1 : Rmax (slack_fl k x y radius) 0 <= Rmax (R2 - D) 0 + 9.3e-16 * R2).
  assert (q := Rmax_r (R2 - D) 0); assert (q' := Rmax_l (R2 - D) 0); apply Rmax_lub; [| lra].
  destruct (Rle_lt_dec (slack_fl k x y radius) 0) as [neg | pos]; [lra |].
  assert (few := out_of_range k x y radius k3 doubles radius0 (Rle_ge _ _ (Rlt_le _ _ pos))).
  assert (E := slack_error k x y radius k3 doubles radius0 few); fold R2 D in E; apply near in E; lra.
assert (s0 := Rmax_r (slack_fl k x y radius) 0); set (s := Rmax (slack_fl k x y radius) 0) in *.
assert (t0 : 0 <= Rmax (R2 - D) 0 <= R2) by (split; [apply Rmax_r | apply Rmax_lub; lra]); set (t := Rmax (R2 - D) 0) in *.
assert (F := fl_error (/ 4 * gamma)); rewrite (Rabs_pos_eq (/ 4 * gamma)) in F by lra; apply near in F.
assert (f0 : 0 <= fl (/ 4 * gamma)) by (apply fl_nonneg; lra); set (g := fl (/ 4 * gamma)) in *; unfold held_bound_fl; fold g s.
assert (p0 : 0 <= g * s) by (apply Rmult_le_pos; lra).
assert (G := fl_error (g * s)); rewrite (Rabs_pos_eq (g * s)) in G by lra; apply near in G.
assert (gs : g * s <= ((1 + u) * (/ 4 * gamma) + eta) * (t + 9.3e-16 * R2)) by (apply Rmult_le_compat; lra).
assert (a : gamma * t <= 1 * R2) by (apply Rmult_le_compat; lra); assert (a0 : 0 <= gamma * t) by (apply Rmult_le_pos; lra).
assert (c : gamma * R2 <= 1 * R2) by (apply Rmult_le_compat_r; lra); assert (c0 : 0 <= gamma * R2) by (apply Rmult_le_pos; lra).
assert (d : eta * t <= eta * 1e12) by (apply Rmult_le_compat_l; lra); assert (d' : eta * R2 <= eta * 1e12) by (apply Rmult_le_compat_l; lra).
assert (tiny : 1e14 * eta <= 1e-30) by lra.
assert (nonneg : 0 <= fl (g * s)) by (apply fl_nonneg; lra).
rewrite U in *; lra.
Qed.

Theorem held_row_real : held_row_fl -> dot r m k + square k m <= gamma / 4 * Rmax (R2 - D) 0 + held_wrong.
Proof.
intro H; assert (M := formed_means k (offset_fl x y) v 1 held_bound_fl scale k3 ltac:(lra) scale_range largest_small v_small H); clear H.
assert (U := u_value); assert (n0 := eta_pos); assert (ns := eta_small); assert (l := least_small); assert (l0 := least_pos); assert (rr := R2_is).
destruct held_bound_enough as [B [B0 B1]]; rewrite Rmax_left in M by exact B0.
assert (wr : forall d, Rabs (offset_fl x y d - r d) <= u * Rabs (r d) + eta) by (intro d; apply fl_error).
assert (d1 := dot_near (offset_fl x y) r v u eta wr k); assert (z1 := size_near (offset_fl x y) r v u eta wr k).
assert (d2 := dot_near m v r (3 * u) least made_of_v k); assert (q := square_near_moved m v k k3 v_small made_of_v).
assert (sv := sum_abs_few v 1e9 k k3 ltac:(lra) v_small); assert (sr := sum_abs_few r 1e9 k k3 ltac:(lra) offset_small).
assert (swap : forall a b : nat -> R, dot a b k = dot b a k /\ size a b k = size b a k).
  clear; intros a b; induction k as [| j [I1 I2]]; cbn [dot size]; [lra | rewrite I1, I2, (Rmult_comm (a j)); lra].
rewrite (proj1 (swap m r)), (proj1 (swap v r)), (proj2 (swap v r)) in d2; apply near in d1; apply near in d2.
assert (A0 : 0 < 1.001 * radius) by lra.
assert (Ar : dot r r k <= 1.001 * radius * (1.001 * radius)).
  change (dot r r k) with D; unfold R2 in *; lra.
assert (S := size_small r v (1.001 * radius) rho k A0 ltac:(lra) Ar v_short); assert (S0 := size_nonneg r v k); assert (W0 := square_nonneg k v).
unfold row_size, held_wrong in *; set (W := square k v) in *; set (Z := size r v k) in *; set (Av := sum_abs v k) in *; set (Ar' := sum_abs r k) in *.
assert (nA : eta * Av <= eta * 3e9) by (apply Rmult_le_compat_l; lra); assert (nA0 : 0 <= eta * Av) by (apply Rmult_le_pos; lra).
assert (nR : least * Ar' <= least * 3e9) by (apply Rmult_le_compat_l; lra); assert (nR0 : 0 <= least * Ar') by (apply Rmult_le_pos; lra).
assert (T := least_is 1e22 ltac:(lra)); assert (rq : 0 <= radius * rho) by (apply Rmult_le_pos; lra); assert (qq : 0 <= rho * rho) by apply Rle_0_sqr.
rewrite U in *; lra.
Qed.
End OneEnd.

(* Both ends. The parts t and s of their moves are done. *)
Section Pair.
Variables (k : nat) (x y : nat -> R) (radius gamma rho scale scale' : R) (v w mv mw : nat -> R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis radius_range : 1e-3 <= radius <= 1e6.
Hypothesis gamma_range : 0 < gamma <= 1.
Hypothesis rho_range : 0 < rho <= 1e6.
Let R2 := radius * radius.
Let D := distance2 k x y.
Hypothesis in_sight : D <= 1.002 * R2.
Hypothesis short : square k v <= rho * rho /\ square k w <= rho * rho.
Hypothesis small : forall d, Rabs (v d) <= 1e9 /\ Rabs (w d) <= 1e9 /\ Rabs (x d - y d) <= 1e8.
Hypothesis made : forall d, Rabs (mv d - v d) <= 3 * u * Rabs (v d) + least /\ Rabs (mw d - w d) <= 3 * u * Rabs (w d) + least.
Hypothesis scales : 1 <= scale * largest (offset_fl x y) 1 k < 2 /\ 1 <= scale' * largest (offset_fl y x) 1 k < 2.
Hypothesis rows : held_row_fl k x y radius gamma scale v /\ held_row_fl k y x radius gamma scale' w.
Variables t s : R.
Hypothesis parts : 0 <= t <= 1 /\ 0 <= s <= 1.
(* The offset then. *)
Definition then_offset c := (x c + t * mv c) - (y c + s * mw c).

Lemma offset_largest a b : (forall d, Rabs (a d - b d) <= 1e8) -> largest (offset_fl a b) 1 k <= 1e9.
Proof.
intro near_by; assert (U := u_value); assert (ns := eta_small); assert (l := least_small); clear - near_by U ns l.
induction k as [| j IH]; cbn [largest]; [lra |]; apply Rmax_lub; [| exact IH].
assert (F := fl_error (a j - b j)); assert (N := near_by j); unfold offset_fl; replace (fl (a j - b j)) with ((fl (a j - b j) - (a j - b j)) + (a j - b j)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite U in F; lra.
Qed.

Lemma other_way : distance2 k y x = D.
Proof.
unfold D, distance2, offset; clear; induction k as [| j IH]; cbn [dot]; [reflexivity | rewrite IH; ring].
Qed.

Theorem held_tick_rounded : dot then_offset then_offset k <= D + gamma * Rmax (R2 - D) 0 + 4 * held_wrong radius rho.
Proof.
destruct short as [sv sw]; destruct scales as [cv cw]; destruct rows as [hv hw]; destruct parts as [t01 s01].
assert (ov : forall d, Rabs (offset x y d) <= 1e9) by (intro d; destruct (small d) as [_ [_ o]]; unfold offset; lra).
assert (yx : forall d, Rabs (y d - x d) <= 1e8) by (intro d; destruct (small d) as [_ [_ o]]; rewrite Rabs_minus_sym; exact o).
assert (ow : forall d, Rabs (offset y x d) <= 1e9) by (intro d; assert (o := yx d); unfold offset; lra).
assert (same := other_way).
assert (A := held_row_real k x y radius gamma rho scale v mv k3 doubles radius_range gamma_range rho_range in_sight sv (fun d => proj1 (small d)) (fun d => proj1 (made d)) cv
  (offset_largest x y (fun d => proj2 (proj2 (small d)))) ov hv).
assert (B := held_row_real k y x radius gamma rho scale' w mw k3 (fun d => conj (proj2 (doubles d)) (proj1 (doubles d))) radius_range gamma_range rho_range
  ltac:(rewrite same; exact in_sight) sw (fun d => proj1 (proj2 (small d))) (fun d => proj2 (made d)) cw (offset_largest y x yx) ow hw).
rewrite same in B; fold R2 D in A, B.
assert (B' : - dot (offset x y) mw k + square k mw <= gamma / 4 * Rmax (R2 - D) 0 + held_wrong radius rho).
  apply Rle_trans with (2 := B); apply Req_le; f_equal; unfold offset; clear; induction k as [| j IH]; cbn [dot]; [ring | rewrite <- IH; ring].
set (E := gamma / 4 * Rmax (R2 - D) 0 + held_wrong radius rho) in *.
assert (E0 : 0 <= E).
  assert (0 <= gamma / 4 * Rmax (R2 - D) 0) by (apply Rmult_le_pos; [lra | apply Rmax_r]).
  assert (0 <= R2) by (apply Rmult_le_pos; lra); assert (0 <= radius * rho) by (apply Rmult_le_pos; lra); assert (0 <= rho * rho) by apply Rle_0_sqr.
  unfold E, held_wrong; fold R2; lra.
assert (part : forall q a b, 0 <= q <= 1 -> 0 <= b -> a + b <= E -> q * a + q * q * b <= E).
  intros q a b q01 b0 ab; assert (0 <= q * (1 - q) * b) by (apply Rmult_le_pos; [apply Rmult_le_pos |]; lra).
  assert (q * (a + b) <= q * E) by (apply Rmult_le_compat_l; lra); assert (q * E <= 1 * E) by (apply Rmult_le_compat_r; lra); lra.
assert (PA := part t _ _ t01 (square_nonneg k mv) A); assert (PB := part s _ _ s01 (square_nonneg k mw) B').
assert (grown : dot then_offset then_offset k <= D + 2 * (t * dot (offset x y) mv k + t * t * square k mv) + 2 * (s * - dot (offset x y) mw k + s * s * square k mw)).
  unfold D, distance2, square, then_offset, offset; clear; induction k as [| j IH]; cbn [dot]; [lra |].
  assert (0 <= (t * mv j + s * mw j) * (t * mv j + s * mw j)) by apply Rle_0_sqr; lra.
unfold E in *; lra.
Qed.

Corollary held_or_no_longer : dot then_offset then_offset k <= Rmax D R2 + 4 * held_wrong radius rho.
Proof.
assert (H := held_tick_rounded); apply Rle_trans with (1 := H); apply Rplus_le_compat_r; unfold Rmax.
destruct (Rle_dec (R2 - D) 0); destruct (Rle_dec D R2); try lra.
assert (gamma * (R2 - D) <= 1 * (R2 - D)) by (apply Rmult_le_compat_r; lra); lra.
Qed.
End Pair.

(* A whole tick: velocities p and q are held for T of the H that displacements are for, and places are stored. *)
Section Step.
Variables (k : nat) (x y : nat -> R) (radius gamma rho scale scale' span T H : R) (v w p q : nat -> R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis radius_range : 1e-3 <= radius <= 1e6.
Hypothesis gamma_range : 0 < gamma <= 1.
Hypothesis rho_range : 0 < rho <= radius.
Hypothesis span_range : 0 <= span <= 1e7.
Hypothesis times : 0 < T <= H.
Let R2 := radius * radius.
Let D := distance2 k x y.
Hypothesis in_sight : D <= 1.002 * R2.
Hypothesis short : square k v <= rho * rho /\ square k w <= rho * rho.
Hypothesis small : forall d, Rabs (v d) <= 1e9 /\ Rabs (w d) <= 1e9.
Hypothesis made : forall d, Rabs (H * p d - v d) <= 3 * u * Rabs (v d) + least /\ Rabs (H * q d - w d) <= 3 * u * Rabs (w d) + least.
Hypothesis scales : 1 <= scale * largest (offset_fl x y) 1 k < 2 /\ 1 <= scale' * largest (offset_fl y x) 1 k < 2.
Hypothesis rows : held_row_fl k x y radius gamma scale v /\ held_row_fl k y x radius gamma scale' w.
Hypothesis before : forall c, Rabs (x c) <= span /\ Rabs (y c) <= span.
Hypothesis after : forall c, Rabs (moved_fl T (x c) (p c)) <= span /\ Rabs (moved_fl T (y c) (q c)) <= span.

Definition step_wrong radius rho span := 4 * held_wrong radius rho + 2.41e-15 * (span * radius) + 2e-30 * (span * span) + 1e-270.

Theorem held_step_rounded : dot (offset_stored T x y p q) (offset_stored T x y p q) k <= Rmax D R2 + step_wrong radius rho span.
Proof.
assert (part : 0 <= T / H <= 1).
  split; [apply Rlt_le, Rdiv_lt_0_compat; lra | apply Rmult_le_reg_r with H; [lra | unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; lra]].
assert (all : forall d, Rabs (v d) <= 1e9 /\ Rabs (w d) <= 1e9 /\ Rabs (x d - y d) <= 1e8).
  intro d; destruct (small d) as [a b]; destruct (before d) as [c e]; repeat split; try assumption.
  apply Rabs_le_inv in c; apply Rabs_le_inv in e; apply Rabs_le; lra.
assert (E := held_or_no_longer k x y radius gamma rho scale scale' v w (fun c => H * p c) (fun c => H * q c) k3 doubles radius_range gamma_range
  ltac:(lra) in_sight short all made scales rows (T / H) (T / H) (conj part part)).
assert (is : forall c, then_offset x y (fun c => H * p c) (fun c => H * q c) (T / H) (T / H) c = offset_exact T x y p q c).
  intro c; unfold then_offset, offset_exact, moved; field; lra.
assert (same : dot (then_offset x y (fun c => H * p c) (fun c => H * q c) (T / H) (T / H)) (then_offset x y (fun c => H * p c) (fun c => H * q c) (T / H) (T / H)) k =
  dot (offset_exact T x y p q) (offset_exact T x y p q) k).
  clear - is; induction k as [| j IH]; cbn [dot]; [reflexivity | rewrite IH, is; reflexivity].
rewrite same in E; fold R2 D in E; clear same is.
assert (A := distance_after_move T span ltac:(lra) k x y p q k3 before after); apply near in A.
set (exact := dot (offset_exact T x y p q) (offset_exact T x y p q) k) in *; set (stored := dot (offset_stored T x y p q) (offset_stored T x y p q) k) in *.
assert (P : 0 <= exact) by apply (square_nonneg k (offset_exact T x y p q)).
assert (r0 : 1e-6 <= R2) by (unfold R2; apply Rle_trans with (1e-3 * 1e-3); [lra | apply Rmult_le_compat; lra]).
assert (mr : 0 <= radius * rho <= R2) by (unfold R2; split; [apply Rmult_le_pos | apply Rmult_le_compat_l]; lra).
assert (mm : 0 <= rho * rho <= R2) by (unfold R2; split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
assert (top : exact <= 1.0016 * radius * (1.0016 * radius)).
  apply Rle_trans with (1 := E); assert (Rmax D R2 <= 1.002 * R2) by (apply Rmax_lub; lra); unfold held_wrong; fold R2.
  replace (1.0016 * radius * (1.0016 * radius)) with (1.0016 * 1.0016 * R2) by (unfold R2; ring); lra.
assert (root : sqrt exact <= 1.0016 * radius) by (rewrite <- (sqrt_square (1.0016 * radius)) by lra; apply sqrt_le_1; [exact P | apply Rmult_le_pos; lra | exact top]).
assert (span * sqrt exact <= span * (1.0016 * radius)) by (apply Rmult_le_compat_l; lra).
assert (0 <= span * radius) by (apply Rmult_le_pos; lra).
unfold step_wrong; lra.
Qed.
End Step.

(* A run: x and y as they are stored at each tick, and all else of that tick. *)
Section Run.
Variables (k : nat) (x y v w p q : nat -> nat -> R) (radius gamma rho span T H whole : R) (scale scale' : nat -> R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis start : forall d, double (x O d) /\ double (y O d).
Hypothesis moves : forall i d, x (S i) d = moved_fl T (x i d) (p i d) /\ y (S i) d = moved_fl T (y i d) (q i d).
Hypothesis radius_range : 1e-3 <= radius <= 1e6.
Hypothesis gamma_range : 0 < gamma <= 1.
Hypothesis rho_range : 0 < rho <= radius / 50.
Hypothesis span_range : 0 <= span <= 10 * radius.
Hypothesis times : 0 < T <= H.
Hypothesis inside : forall i d, Rabs (x i d) <= span /\ Rabs (y i d) <= span.
Hypothesis short : forall i, square k (v i) <= rho * rho /\ square k (w i) <= rho * rho.
Hypothesis small : forall i d, Rabs (v i d) <= 1e9 /\ Rabs (w i d) <= 1e9.
Hypothesis made : forall i d, Rabs (H * p i d - v i d) <= 3 * u * Rabs (v i d) + least /\ Rabs (H * q i d - w i d) <= 3 * u * Rabs (w i d) + least.
Hypothesis scales : forall i, 1 <= scale i * largest (offset_fl (x i) (y i)) 1 k < 2 /\ 1 <= scale' i * largest (offset_fl (y i) (x i)) 1 k < 2.
(* Both rows hold in every tick. *)
Hypothesis rows : forall i, held_row_fl k (x i) (y i) radius gamma (scale i) (v i) /\ held_row_fl k (y i) (x i) radius gamma (scale' i) (w i).
(* R_h = R (1 - 1e-9), rounded. *)
Hypothesis hair : radius * (1 + 9.9e-10) <= whole.

Lemma stored_double i : forall d, double (x i d) /\ double (y i d).
Proof. destruct i as [| i]; intro d; [apply start | destruct (moves i d) as [-> ->]; split; apply fl_double]. Qed.

Lemma held_run i : distance2 k (x O) (y O) <= radius * radius * (1 + 1.001e-9) -> INR i <= 70000 ->
  distance2 k (x i) (y i) <= Rmax (distance2 k (x O) (y O)) (radius * radius) + INR i * (2.62e-14 * (radius * radius)).
Proof.
assert (r0 : 1e-6 <= radius * radius) by (apply Rle_trans with (1e-3 * 1e-3); [lra | apply Rmult_le_compat; lra]).
intro begun; induction i as [| i IH]; intro few; [simpl INR; assert (M := Rmax_l (distance2 k (x O) (y O)) (radius * radius)); lra |].
rewrite S_INR in *; assert (i0 := pos_INR i); assert (I := IH ltac:(lra)); clear IH; set (D0 := distance2 k (x O) (y O)) in *.
assert (M : Rmax D0 (radius * radius) <= radius * radius * (1 + 1.001e-9)) by (apply Rmax_lub; lra); assert (M' := Rmax_r D0 (radius * radius)).
assert (far : INR i * (2.62e-14 * (radius * radius)) <= 70000 * (2.62e-14 * (radius * radius))) by (apply Rmult_le_compat_r; lra).
assert (after : forall c, Rabs (moved_fl T (x i c) (p i c)) <= span /\ Rabs (moved_fl T (y i c) (q i c)) <= span).
  intro c; destruct (moves i c) as [<- <-]; apply inside.
assert (St := held_step_rounded k (x i) (y i) radius gamma rho (scale i) (scale' i) span T H (v i) (w i) (p i) (q i) k3 (stored_double i) radius_range gamma_range
  ltac:(lra) ltac:(lra) times ltac:(lra) (short i) (small i) (made i) (scales i) (rows i) (inside i) after).
assert (is : dot (offset_stored T (x i) (y i) (p i) (q i)) (offset_stored T (x i) (y i) (p i) (q i)) k = distance2 k (x (S i)) (y (S i))).
  unfold distance2; clear - moves; induction k as [| j IH]; cbn [dot]; [reflexivity | rewrite IH; unfold offset_stored, offset; destruct (moves i j) as [-> ->]; reflexivity].
rewrite is in St; clear is.
assert (wrong : step_wrong radius rho span <= 2.62e-14 * (radius * radius)).
  assert (a : radius * rho <= radius * (radius / 50)) by (apply Rmult_le_compat_l; lra).
  assert (b : rho * rho <= radius / 50 * (radius / 50)) by (apply Rmult_le_compat; lra).
  assert (c : span * radius <= 10 * radius * radius) by (apply Rmult_le_compat_r; lra).
  assert (d : span * span <= 10 * radius * (10 * radius)) by (apply Rmult_le_compat; lra).
  unfold step_wrong, held_wrong; lra.
assert (Rmax (distance2 k (x i) (y i)) (radius * radius) <= Rmax D0 (radius * radius) + INR i * (2.62e-14 * (radius * radius))).
  apply Rmax_lub; [exact I |]; assert (0 <= INR i * (2.62e-14 * (radius * radius))) by (apply Rmult_le_pos; lra); lra.
lra.
Qed.

Theorem held_within_hair i :
  (distance2 k (x O) (y O) <= radius * radius /\ INR i <= 70000) \/
  (distance2 k (x O) (y O) <= radius * radius * (1 + 1.001e-9) /\ INR i <= 35000) -> distance2 k (x i) (y i) <= whole * whole.
Proof.
assert (r0 : 1e-6 <= radius * radius) by (apply Rle_trans with (1e-3 * 1e-3); [lra | apply Rmult_le_compat; lra]).
assert (wide : radius * (1 + 9.9e-10) * (radius * (1 + 9.9e-10)) <= whole * whole) by (apply Rmult_le_compat; lra).
intros [[begun few] | [begun few]].
  assert (G := held_run i ltac:(lra) few); rewrite Rmax_right in G by exact begun.
  assert (INR i * (2.62e-14 * (radius * radius)) <= 70000 * (2.62e-14 * (radius * radius))) by (apply Rmult_le_compat_r; lra); lra.
assert (G := held_run i begun ltac:(lra)).
assert (Rmax (distance2 k (x O) (y O)) (radius * radius) <= radius * radius * (1 + 1.001e-9)) by (apply Rmax_lub; lra).
assert (INR i * (2.62e-14 * (radius * radius)) <= 35000 * (2.62e-14 * (radius * radius))) by (apply Rmult_le_compat_r; lra); lra.
Qed.
End Run.
