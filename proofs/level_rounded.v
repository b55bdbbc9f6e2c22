(* The level of a robot: a sum of weights from positions, to the last digit (docs/theory/weights.md, lem:degree).

   In words. n weights of at most A, each computed with an error of at most d, are added one after the other. The sum is wrong by at most
   (1 + u)^n (n d + u A n (n + 1)/2 + n 1e-300) with u = 2^-53 (`level_bound`). So it grows with the square of the number of weights: what is rounded is the
   sum so far. n is how many links one robot has, at most the size of the team less one.

   `link_level_error`: with weights computed from positions as in link_rounded.v and n <= 10,000 the level is wrong by at most
   1.001 (n (3.3e-15 + 3.7e-16 q1 sqrt(q2) R^2) + u (q1/2) n (n + 1)/2) + 1e-290. `h_error`: h = level - need adds at most u |h|.

   What that is in numbers: `level_11` for the eleven robots of the paper and a weight that is at most as steep as `budget` chooses for itself at
   ticks of 5 ms, 6e-13; `level_200` for 200 links of a gentle weight (q1 <= 3, q1 sqrt(q2) R^2 <= 18), 6e-12; and `level_10000`, 6.4e-9 for
   10,000 links of a weight with q1 <= 2.001 and q1 sqrt(q2) R^2 <= 150. So the 1e-11 of the laws has this reason for small teams only. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights rounding link_rounded.
Import ExactIntervals.
Local Open Scope R_scope.

Section Level.
Variables (w a : nat -> R) (d A : R).
Hypothesis d0 : 0 <= d.
Hypothesis A0 : 0 <= A.
Hypothesis weights : forall i, 0 <= a i <= A.
Hypothesis wrong : forall i, Rabs (w i - a i) <= d.

Lemma sum_range n : 0 <= sum a n <= A * INR n.
Proof. induction n as [| n IH]; [simpl; lra | cbn [sum]; rewrite S_INR; assert (H := weights n); lra]. Qed.

Theorem level_bound n : Rabs (sum_fl w n - sum a n) <= (1 + u) ^ n * (INR n * d + u * A * (INR n * (INR n + 1) / 2) + INR n * least).
Proof.
assert (U := u_pos); assert (E := eta_pos); assert (small := eta_small).
induction n as [| n IH]; [simpl; rewrite Rminus_0_r, Rabs_R0; lra |].
cbn [sum_fl sum]; assert (r := sum_range (S n)); cbn [sum] in r.
assert (step : Rabs (sum_fl w n + w n - (sum a n + a n)) <= (1 + u) ^ n * (INR n * d + u * A * (INR n * (INR n + 1) / 2) + INR n * least) + d).
  replace (_ - _) with ((sum_fl w n - sum a n) + (w n - a n)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); assert (H := wrong n); lra.
assert (total : Rabs (sum a n + a n) <= A * INR (S n)) by (rewrite Rabs_pos_eq; lra).
apply Rle_trans with (1 := fl_of _ _ _ _ step total).
rewrite S_INR; cbn [pow]; assert (P := power_ge_1 n); assert (N := pos_INR n).
set (X := INR n * d + u * A * (INR n * (INR n + 1) / 2) + INR n * least); set (p := (1 + u) ^ n) in *.
replace ((INR n + 1) * d + u * A * ((INR n + 1) * (INR n + 1 + 1) / 2) + (INR n + 1) * least) with (X + (d + (u * A * (INR n + 1) + least))) by (unfold X; field).
assert (p1 : 1 <= (1 + u) * p) by nra.
assert (h1 : (1 + u) * d <= (1 + u) * p * d) by (apply Rmult_le_compat_r; [exact d0 | nra]).
assert (t0 : 0 <= u * A * (INR n + 1) + least) by (assert (0 <= u * A * (INR n + 1)) by (apply Rmult_le_pos; [apply Rmult_le_pos | ]; lra); lra).
assert (h2 : 1 * (u * A * (INR n + 1) + least) <= (1 + u) * p * (u * A * (INR n + 1) + least)) by (apply Rmult_le_compat_r; assumption).
lra.
Qed.

Lemma power_few n : (n <= 10000)%nat -> (1 + u) ^ n <= 1.001.
Proof.
intro few; apply Rle_trans with ((1 + u) ^ 10000); [apply Rle_pow; [assert (U := u_pos); lra | exact few] |].
rewrite u_value, <- (Rpower_pow 10000) by lra; rewrite INR_IZR_INZ; replace (Z.of_nat 10000) with 10000%Z by (vm_compute; reflexivity).
unfold Rpower; interval with (i_prec 80).
Qed.
End Level.

Section Links.
Variables (k : nat) (own : nat -> R) (other : nat -> nat -> R) (q1 q2 radius : R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis own_double : forall c, double (own c).
Hypothesis other_double : forall i c, double (other i c).
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Hypothesis radius_range : 0 <= radius <= 1e6.
Let R2 := radius * radius.
Definition weight_computed i := weight_at_fl q1 q2 (slack_fl k own (other i) radius).
Definition weight_real i := weight q1 q2 R2 (distance2 k own (other i)).
Definition link_wrong := 3.3e-15 + 3.7e-16 * (q1 * sqrt q2 * R2).

Lemma link_wrong_nonneg : 0 <= link_wrong.
Proof.
assert (0 <= q1 * sqrt q2 * R2).
  apply Rmult_le_pos; [apply Rmult_le_pos; [lra | apply sqrt_pos] | apply (R2_range radius radius_range)].
unfold link_wrong; lra.
Qed.

Theorem link_level_error n : (n <= 10000)%nat -> Rabs (sum_fl weight_computed n - sum weight_real n) <=
  1.001 * (INR n * link_wrong + u * (q1 / 2) * (INR n * (INR n + 1) / 2)) + 1e-290.
Proof.
intro few; assert (U := u_pos); assert (L := link_wrong_nonneg).
assert (each : forall i, Rabs (weight_computed i - weight_real i) <= link_wrong).
  intro i; apply link_error; try assumption; intro c; split; [apply own_double | apply other_double].
assert (range : forall i, 0 <= weight_real i <= q1 / 2).
  intro i; unfold weight_real; split; [apply weight_nonneg | apply weight_below]; lra.
assert (B := level_bound weight_computed weight_real link_wrong (q1 / 2) L ltac:(lra) range each n).
assert (p := power_few n few); assert (P := power_ge_1 n); assert (N := pos_INR n).
set (X := INR n * link_wrong + u * (q1 / 2) * (INR n * (INR n + 1) / 2)) in *.
assert (X0 : 0 <= X).
  assert (0 <= INR n * link_wrong) by (apply Rmult_le_pos; lra).
  assert (0 <= INR n * (INR n + 1) / 2) by (assert (0 <= INR n * (INR n + 1)) by (apply Rmult_le_pos; lra); lra).
  assert (0 <= u * (q1 / 2) * (INR n * (INR n + 1) / 2)) by (apply Rmult_le_pos; [apply Rmult_le_pos |]; lra).
  unfold X; lra.
assert (N4 : INR n <= 10000) by (replace 10000 with (INR 10000) by (rewrite INR_IZR_INZ; f_equal; vm_compute; reflexivity); apply le_INR; exact few).
assert (tiny : INR n * least <= 1e-291).
  assert (l0 : 0 < least) by (unfold least; apply Rinv_0_lt_compat, IZR_lt; reflexivity).
  apply Rle_trans with (10000 * least); [apply Rmult_le_compat_r; lra |].
  unfold least; apply Rmult_le_reg_r with (IZR (10 ^ 300)); [apply IZR_lt; reflexivity |].
  rewrite Rmult_assoc, Rinv_l by (apply not_0_IZR; discriminate); simpl; lra.
assert (l1 : 0 <= INR n * least) by (apply Rmult_le_pos; [lra | unfold least; apply Rlt_le, Rinv_0_lt_compat, IZR_lt; reflexivity]).
apply Rle_trans with (1 := B); apply Rle_trans with (1.001 * (X + INR n * least)); [apply Rmult_le_compat; lra | lra].
Qed.

(* h = level - need, with need a whole number. *)
Theorem h_error n need e : Rabs (sum_fl weight_computed n - sum weight_real n) <= e ->
  let h := sum weight_real n - need in Rabs (fl (sum_fl weight_computed n - need) - h) <= (1 + u) * e + u * Rabs h + eta.
Proof.
intros H h; apply fl_of; [| apply Rle_refl].
unfold h; replace (_ - _) with (sum_fl weight_computed n - sum weight_real n) by ring; exact H.
Qed.

Lemma level_few n m : (n <= m)%nat -> (m <= 10000)%nat -> Rabs (sum_fl weight_computed n - sum weight_real n) <=
  1.001 * (INR m * link_wrong + u * (q1 / 2) * (INR m * (INR m + 1) / 2)) + 1e-290.
Proof.
intros nm few; assert (H := link_level_error n ltac:(lia)); assert (L := link_wrong_nonneg); assert (U := u_pos).
assert (N := pos_INR n); assert (M := le_INR _ _ nm).
assert (INR n * link_wrong <= INR m * link_wrong) by (apply Rmult_le_compat_r; lra).
assert (INR n * (INR n + 1) <= INR m * (INR m + 1)) by (apply Rmult_le_compat; lra).
assert (u * (q1 / 2) * (INR n * (INR n + 1) / 2) <= u * (q1 / 2) * (INR m * (INR m + 1) / 2)) by (apply Rmult_le_compat_l; [apply Rmult_le_pos |]; lra).
lra.
Qed.

Theorem level_11 n : (n <= 10)%nat -> q1 <= 2.34 -> q1 * sqrt q2 * R2 <= 147 -> Rabs (sum_fl weight_computed n - sum weight_real n) <= 6e-13.
Proof.
intros few gentle steep; assert (less : (10 <= 10000)%nat) by (apply Nat.leb_le; vm_compute; reflexivity).
apply Rle_trans with (1 := level_few n 10 few less).
replace (INR 10) with 10 by (simpl; lra); unfold link_wrong; rewrite u_value; lra.
Qed.

Theorem level_200 n : (n <= 200)%nat -> q1 <= 3 -> q1 * sqrt q2 * R2 <= 18 -> Rabs (sum_fl weight_computed n - sum weight_real n) <= 6e-12.
Proof.
intros few gentle steep; assert (less : (200 <= 10000)%nat) by (apply Nat.leb_le; vm_compute; reflexivity).
apply Rle_trans with (1 := level_few n 200 few less).
replace (INR 200) with 200 by (simpl; lra); unfold link_wrong; rewrite u_value; lra.
Qed.

Theorem level_10000 n : (n <= 10000)%nat -> q1 <= 2.001 -> q1 * sqrt q2 * R2 <= 150 -> Rabs (sum_fl weight_computed n - sum weight_real n) <= 6.4e-9.
Proof.
intros few gentle steep; apply Rle_trans with (1 := level_few n 10000 few (le_n _)).
replace (INR 10000) with 10000 by (rewrite INR_IZR_INZ; f_equal; vm_compute; reflexivity).
unfold link_wrong; rewrite u_value; lra.
Qed.
End Links.
