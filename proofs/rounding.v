(* What rounding does to rows, distances and sums of weights as they are computed (docs/theory/program.md, sec:holds).

   In words. Numbers are doubles: every operation gives the exact result x rounded to nearest, so that it is wrong by at most
   u |x| + eta, with u = 2^-53 and eta = 2^-1075 (`fl_error`, from Flocq). Nothing overflows.

   `dot_error`: a product a.b of k dimensions, summed from the first on, is wrong by at most ((1 + u)^(k+1) - 1) times the sum of the |a_d b_d|.
   `row_error`: so is n.v + c |v|^2 in up to three dimensions, by at most 7 u times its size, the sum of the absolute values of its terms.
   `holds_means`: if `Row::holds` says yes, n.v + c |v|^2 <= (1 + u) bound + 40 u size + 1e-300 in exact arithmetic.
   `sum_error`, `level_error`: a sum of up to 200 weights of at most 1.5, each wrong by at most 1e-14, is wrong by less than 1e-11.
   `distance_error`: a squared distance in up to three dimensions is wrong by at most 8e-16 of itself and 1e-300. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Flocq Require Import Relative Plus_error.
From Interval Require Import Tactic.
From Closeranks Require Import intervals.
Import ExactIntervals.
Local Open Scope R_scope.

Definition u := / 2 * bpow radix2 (-53 + 1).
Definition eta := / 2 * bpow radix2 (-1074).
Definition fl x := round radix2 (FLT_exp (-1074) 53) ZnearestE x.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Lemma u_value : u = / 9007199254740992. Proof. unfold u; simpl; lra. Qed.
Lemma u_pos : 0 < u. Proof. rewrite u_value; lra. Qed.
Lemma eta_pos : 0 < eta. Proof. unfold eta; assert (H := bpow_gt_0 radix2 (-1074)); lra. Qed.
(* 1e-300 *)
Definition least := / IZR (10 ^ 300).
Lemma eta_small : eta <= least / 1000000.
Proof.
unfold eta, least; rewrite bpow_opp with (e := 1074%Z), <- (IZR_Zpower radix2 1074) by lia.
assert (big : IZR (1000000 * 10 ^ 300) <= IZR (2 ^ 1074)) by (apply IZR_le; vm_compute; discriminate).
rewrite mult_IZR in big; assert (pos : 0 < IZR (10 ^ 300)) by (apply IZR_lt; reflexivity).
change (radix_val radix2) with 2%Z.
assert (le : / IZR (2 ^ 1074) <= / (1000000 * IZR (10 ^ 300))) by (apply Rinv_le_contravar; lra).
rewrite Rinv_mult in le; assert (0 < / IZR (2 ^ 1074)) by (apply Rinv_0_lt_compat; lra); lra.
Qed.

Lemma fl_error x : Rabs (fl x - x) <= u * Rabs x + eta.
Proof.
destruct (error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) x) as [e [h [He [Hh [_ E]]]]].
unfold fl; rewrite E; replace (x * (1 + e) + h - x) with (x * e + h) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_mult; fold u in He; fold eta in Hh.
assert (Rabs x * Rabs e <= Rabs x * u) by (apply Rmult_le_compat_l; [apply Rabs_pos | exact He]); lra.
Qed.

(* Rounding what is wrong by d already. *)
Lemma fl_of x y d s : Rabs (x - y) <= d -> Rabs y <= s -> Rabs (fl x - y) <= (1 + u) * d + u * s + eta.
Proof.
intros Hd Hs; assert (H := fl_error x); assert (U := u_pos).
assert (Rabs x <= s + d) by (replace x with (y + (x - y)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra).
assert (u * Rabs x <= u * (s + d)) by (apply Rmult_le_compat_l; lra).
replace (fl x - y) with ((fl x - x) + (x - y)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra.
Qed.

Section Dot.
Variables a b : nat -> R.
Fixpoint dot k := match k with O => 0 | S k => dot k + a k * b k end.
Fixpoint dot_fl k := match k with O => 0 | S k => fl (dot_fl k + fl (a k * b k)) end.
(* The sum of the absolute values of its terms. *)
Fixpoint size k := match k with O => 0 | S k => size k + Rabs (a k * b k) end.
Definition grow k := (1 + u) ^ k - 1.
Definition tiny k := 3 * INR k * eta * (1 + u) ^ k.

Lemma power_ge_1 k : 1 <= (1 + u) ^ k.
Proof. apply pow_R1_Rle; assert (U := u_pos); lra. Qed.
Lemma size_nonneg k : 0 <= size k.
Proof. induction k as [| k IH]; simpl; [lra | assert (H := Rabs_pos (a k * b k)); lra]. Qed.
Lemma dot_le_size k : Rabs (dot k) <= size k.
Proof.
induction k as [| k IH]; simpl; [rewrite Rabs_R0; lra |].
apply Rle_trans with (1 := Rabs_triang _ _); lra.
Qed.

Theorem dot_error k : Rabs (dot_fl k - dot k) <= grow (S k) * size k + tiny k.
Proof.
assert (U := u_pos); assert (E := eta_pos); induction k as [| k IH].
  simpl; unfold tiny, grow; simpl; rewrite Rminus_0_r, Rabs_R0; lra.
cbn [dot_fl dot size]; set (t := a k * b k) in *.
assert (T := fl_error t); assert (Dk := dot_le_size k); assert (S0 := size_nonneg k); assert (T0 := Rabs_pos t).
assert (sum : Rabs (dot_fl k + fl t - (dot k + t)) <= grow (S k) * size k + tiny k + (u * Rabs t + eta)).
  replace (dot_fl k + fl t - (dot k + t)) with ((dot_fl k - dot k) + (fl t - t)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); lra.
assert (total : Rabs (dot k + t) <= size k + Rabs t) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
apply Rle_trans with (1 := fl_of _ _ _ _ sum total).
unfold grow, tiny in *; rewrite S_INR; cbn [pow]; assert (P := power_ge_1 k); assert (K := pos_INR k).
set (p := (1 + u) ^ k) in *; set (n := INR k) in *.
assert (h1 : (2 * u + u * u) * Rabs t <= ((1 + u) * ((1 + u) * p) - 1) * Rabs t).
  apply Rmult_le_compat_r; [exact T0 | nra].
assert (h2 : (2 + u) * eta <= 3 * eta * ((1 + u) * p)).
  assert (2 + u <= 3 * ((1 + u) * p)) by nra. nra.
nra.
Qed.
End Dot.

Lemma grow_step k : (1 + u) * grow k + u = grow (S k).
Proof. unfold grow; cbn [pow]; ring. Qed.
Lemma grow_mono k : grow k <= grow (S k).
Proof. assert (U := u_pos); assert (P := power_ge_1 k); unfold grow; cbn [pow]; nra. Qed.
Lemma grow_few k : (k <= 6)%nat -> 0 <= grow k <= 7 * u.
Proof.
intro K; assert (U := u_pos); split; [unfold grow; assert (P := power_ge_1 k); lra |].
do 7 (destruct k as [| k]; [unfold grow; cbn [pow]; rewrite u_value; lra |]); lia.
Qed.
Lemma tiny_few k : (k <= 3)%nat -> 0 <= tiny k <= 10 * eta.
Proof.
intro K; assert (E := eta_pos); unfold tiny.
do 4 (destruct k as [| k]; [rewrite u_value; simpl; lra |]); lia.
Qed.

(* n.v + c |v|^2 as `Row::value` computes it. *)
Section Row.
Variables (k : nat) (n v : nat -> R) (c bound : R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis c02 : 0 <= c <= 2.
Definition square := dot v v k.
Definition value_fl (n v : nat -> R) := fl (dot_fl n v k + fl (c * dot_fl v v k)).
Definition row_size := size n v k + c * square.

Lemma size_square : size v v k = square.
Proof.
unfold square; clear k3; induction k as [| j IH]; simpl; [reflexivity |].
rewrite IH, Rabs_pos_eq; [reflexivity | apply Rle_0_sqr].
Qed.
Lemma square_nonneg : 0 <= square.
Proof. rewrite <- size_square; apply size_nonneg. Qed.

Theorem row_error : Rabs (value_fl n v - (dot n v k + c * square)) <= 7 * u * row_size + 200 * eta.
Proof.
assert (U := u_pos); assert (E := eta_pos); assert (W := square_nonneg); assert (S0 := size_nonneg n v k).
assert (Ed := dot_error n v k); assert (Es := dot_error v v k); rewrite size_square in Es; fold square in Es.
assert (T := tiny_few k k3); assert (G := grow_mono (S k)); assert (cW : 0 <= c * square) by (apply Rmult_le_pos; lra).
assert (G1 : 0 <= grow (S k) <= 7 * u) by (apply grow_few; lia).
assert (G3 : grow (S (S (S k))) <= 7 * u) by (apply grow_few; lia).
assert (sq : Rabs (fl (c * dot_fl v v k) - c * square) <=
  (1 + u) * (c * (grow (S k) * square + tiny k)) + u * (c * square) + eta).
  apply fl_of; [| rewrite Rabs_pos_eq; lra].
  rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq c) by lra; apply Rmult_le_compat_l; lra.
assert (sq' : Rabs (fl (c * dot_fl v v k) - c * square) <= grow (S (S k)) * (c * square) + 30 * eta).
  apply Rle_trans with (1 := sq); rewrite <- (grow_step (S k)).
  assert (c * tiny k <= 2 * (10 * eta)) by (apply Rmult_le_compat; lra).
  assert (u <= 1 / 100) by (rewrite u_value; lra).
  assert ((1 + u) * (c * tiny k) <= (1 + 1 / 100) * (20 * eta)) by (apply Rmult_le_compat; [lra | apply Rmult_le_pos; lra | lra | lra]).
  lra.
assert (both : Rabs (dot_fl n v k + fl (c * dot_fl v v k) - (dot n v k + c * square)) <=
  grow (S (S k)) * row_size + 40 * eta).
  replace (_ - _) with ((dot_fl n v k - dot n v k) + (fl (c * dot_fl v v k) - c * square)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); unfold row_size.
  assert (grow (S k) * size n v k <= grow (S (S k)) * size n v k) by (apply Rmult_le_compat_r; lra).
  lra.
assert (all : Rabs (dot n v k + c * square) <= row_size).
  apply Rle_trans with (1 := Rabs_triang _ _); rewrite (Rabs_pos_eq (c * square)) by lra; unfold row_size.
  assert (H := dot_le_size n v k); lra.
unfold value_fl; apply Rle_trans with (1 := fl_of _ _ _ _ both all).
assert (u <= 1 / 100) by (rewrite u_value; lra).
assert (R0 : 0 <= row_size) by (unfold row_size; lra).
assert ((1 + u) * (40 * eta) <= (1 + 1 / 100) * (40 * eta)) by (apply Rmult_le_compat_r; lra).
assert (last : grow (S (S (S k))) * row_size <= 7 * u * row_size) by (apply Rmult_le_compat_r; lra).
rewrite <- (grow_step (S (S k))) in last; lra.
Qed.

(* `Row::holds`: the size is the same sum with absolute values, and the margin is 16 u = 8 * 2^-52 of what they differ by. *)
Definition size_fl := value_fl (fun d => Rabs (n d)) (fun d => Rabs (v d)).
Definition holds := value_fl n v <= bound \/ value_fl n v <= fl (bound + fl (16 * u * fl (size_fl - value_fl n v))).
End Row.

Lemma dot_abs n v k : dot (fun d => Rabs (n d)) (fun d => Rabs (v d)) k = size n v k.
Proof. induction k as [| k IH]; simpl; [reflexivity | rewrite IH, Rabs_mult; reflexivity]. Qed.
Lemma size_abs n v k : size (fun d => Rabs (n d)) (fun d => Rabs (v d)) k = size n v k.
Proof. induction k as [| k IH]; simpl; [reflexivity | rewrite IH, !Rabs_mult, !Rabs_Rabsolu; reflexivity]. Qed.
Lemma square_abs v k : square k (fun d => Rabs (v d)) = square k v.
Proof. unfold square; rewrite dot_abs, size_square; reflexivity. Qed.

Theorem holds_means k n v c bound : (k <= 3)%nat -> 0 <= c <= 2 -> 0 <= bound -> holds k n v c bound ->
  dot n v k + c * square k v <= (1 + u) * bound + 40 * u * row_size k n v c + least.
Proof.
intros k3 c02 b0 H; assert (U := u_pos); assert (E := eta_pos); assert (small := eta_small).
assert (e := row_error k n v c k3 c02).
assert (es := row_error k (fun d => Rabs (n d)) (fun d => Rabs (v d)) c k3 c02).
unfold row_size in es; rewrite dot_abs, size_abs, square_abs in es; fold (row_size k n v c) in es.
assert (W := square_nonneg k v); assert (S0 := size_nonneg n v k).
assert (cW : 0 <= c * square k v) by (apply Rmult_le_pos; lra).
assert (dot n v k + c * square k v <= row_size k n v c /\ - row_size k n v c <= dot n v k + c * square k v).
  assert (D := dot_le_size n v k); unfold row_size; apply Rabs_le_inv in D; lra.
assert (s0 : 0 <= row_size k n v c) by (unfold row_size; lra).
set (size := row_size k n v c) in *; fold (size_fl k n v c) in es.
set (value := dot n v k + c * square k v) in *; set (computed := value_fl k c n v) in *.
apply Rabs_le_inv in e; apply Rabs_le_inv in es; rewrite u_value in *.
destruct H as [H | H]; fold computed in H; [lra |].
set (z := size_fl k n v c - computed) in *.
assert (Z : Rabs z <= 2.001 * size + 400 * eta) by (apply Rabs_le; unfold z; lra).
assert (fz := fl_error z); assert (f16 := fl_error (16 * u * fl z)).
assert (fb := fl_error (bound + fl (16 * u * fl z))); rewrite u_value in *.
assert (X : Rabs (fl z) <= 2.002 * size + 500 * eta).
  replace (fl z) with ((fl z - z) + z) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra.
set (m := 16 * / 9007199254740992 * fl z) in *.
assert (M : Rabs m <= 16 * / 9007199254740992 * (2.002 * size + 500 * eta)).
  unfold m; rewrite Rabs_mult, (Rabs_pos_eq (16 * _)) by lra; apply Rmult_le_compat_l; lra.
assert (Y : Rabs (fl m) <= 32.1 * / 9007199254740992 * size + 2 * eta).
  replace (fl m) with ((fl m - m) + m) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra.
apply Rabs_le_inv in fb; assert (B : Rabs (bound + fl m) <= bound + (32.1 * / 9007199254740992 * size + 2 * eta)).
  apply Rle_trans with (1 := Rabs_triang _ _); rewrite (Rabs_pos_eq bound) by lra; lra.
apply Rabs_le_inv in Y; lra.
Qed.

(* A sum of numbers each of which is wrong by at most d, with partial sums of at most B. *)
Section Sum.
Variables (w a : nat -> R) (d B : R).
Hypothesis d0 : 0 <= d.
Hypothesis B0 : 0 <= B.
Fixpoint sum (a : nat -> R) k := match k with O => 0 | S k => sum a k + a k end.
Fixpoint sum_fl k := match k with O => 0 | S k => fl (sum_fl k + w k) end.
Hypothesis wrong : forall i, Rabs (w i - a i) <= d.

Theorem sum_error k : (forall i, (i <= k)%nat -> Rabs (sum a i) <= B) ->
  Rabs (sum_fl k - sum a k) <= INR k * ((1 + u) * d + u * B + eta) * (1 + u) ^ k.
Proof.
assert (U := u_pos); assert (E := eta_pos); set (c := (1 + u) * d + u * B + eta).
assert (c0 : 0 <= c).
  assert (0 <= (1 + u) * d) by (apply Rmult_le_pos; lra); assert (0 <= u * B) by (apply Rmult_le_pos; lra); unfold c; lra.
induction k as [| k IH]; intro small; [simpl; rewrite Rminus_0_r, Rabs_R0; lra |].
specialize (IH (fun i le => small i (le_S _ _ le))); cbn [sum_fl sum].
assert (step : Rabs (sum_fl k + w k - (sum a k + a k)) <= INR k * c * (1 + u) ^ k + d).
  replace (_ - _) with ((sum_fl k - sum a k) + (w k - a k)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); assert (H := wrong k); lra.
apply Rle_trans with (1 := fl_of _ _ _ _ step (small (S k) (le_n _))).
rewrite S_INR; cbn [pow]; assert (P := power_ge_1 k).
assert (1 <= (1 + u) * (1 + u) ^ k) by nra.
assert (c <= c * ((1 + u) * (1 + u) ^ k)) by nra.
unfold c in *; lra.
Qed.
End Sum.

(* The tolerance of the laws about h: 1e-11. *)
Theorem level_error w a k : (k <= 200)%nat -> (forall i, 0 <= a i <= 1.5) -> (forall i, Rabs (w i - a i) <= 1e-14) ->
  Rabs (sum_fl w k - sum a k) <= 1e-11.
Proof.
intros k200 weights wrong; assert (U := u_pos); assert (E := eta_pos); assert (small := eta_small).
assert (part : forall i, (i <= k)%nat -> Rabs (sum a i) <= 300).
  assert (range : forall i, 0 <= sum a i <= 1.5 * INR i).
    induction i as [| i IH]; [simpl; lra | cbn [sum]; rewrite S_INR; assert (H := weights i); lra].
  intros i le; rewrite Rabs_pos_eq by apply range; assert (H := range i).
  assert (INR i <= 200) by (replace 200 with (INR 200) by (simpl; lra); apply le_INR; lia); lra.
apply Rle_trans with (1 := sum_error w a 1e-14 300 ltac:(lra) ltac:(lra) wrong k part).
assert (K : 0 <= INR k <= 200) by (split; [apply pos_INR | replace 200 with (INR 200) by (simpl; lra); apply le_INR; lia]).
assert (p : (1 + u) ^ k <= 1.01).
  apply Rle_trans with ((1 + u) ^ 200); [apply Rle_pow; [lra | lia] |].
  rewrite u_value; interval with (i_prec 60).
assert (eta <= 1e-30).
  apply Rle_trans with (1 := small); unfold least.
  assert (/ IZR (10 ^ 300) <= / IZR (10 ^ 30)) by (apply Rinv_le_contravar; [apply IZR_lt; reflexivity | apply IZR_le; vm_compute; discriminate]).
  simpl (10 ^ 30)%Z in *; lra.
assert (P := power_ge_1 k).
apply Rle_trans with (200 * (1.1e-14 + 3.4e-14) * 1.01); [| lra].
apply Rmult_le_compat; [apply Rmult_le_pos; [lra |] | lra | apply Rmult_le_compat; try lra | exact p]; rewrite u_value; lra.
Qed.

(* A squared distance, from positions x and y as they are in the machine. *)
Theorem distance_error x y k : (k <= 3)%nat ->
  (forall d, generic_format radix2 (FLT_exp (-1074) 53) (x d) /\ generic_format radix2 (FLT_exp (-1074) 53) (y d)) ->
  let r d := x d - y d in let r_fl d := fl (x d - y d) in
  Rabs (dot_fl r_fl r_fl k - dot r r k) <= 8e-16 * dot r r k + least.
Proof.
intros k3 doubles r r_fl; assert (U := u_pos); assert (E := eta_pos); assert (small := eta_small).
assert (each : forall d, Rabs (r_fl d * r_fl d - r d * r d) <= 3 * u * (r d * r d)).
  intro d; destruct (doubles d) as [fx fy].
  destruct (FLT_plus_error_N_ex radix2 (-1074) 53 (fun n => negb (Z.even n)) (x d) (- y d) fx (generic_format_opp _ _ _ fy)) as [e [He Ee]].
  assert (F : r_fl d = r d * (1 + e)) by exact Ee.
  rewrite F; replace (r d * (1 + e) * (r d * (1 + e)) - r d * r d) with (r d * r d * (2 * e + e * e)) by ring.
  assert (Hu : Rabs e <= u).
    change (u_ro radix2 53) with u in He; apply Rle_trans with (1 := He); apply Rmult_le_reg_r with (1 + u); [lra |].
    unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra; assert (0 <= u * u) by (apply Rmult_le_pos; lra); lra.
  apply Rabs_le_inv in Hu; rewrite u_value in Hu.
  rewrite Rabs_mult, (Rabs_pos_eq (r d * r d)) by apply Rle_0_sqr.
  assert (Rabs (2 * e + e * e) <= 3 * u) by (apply Rabs_le; rewrite u_value; nra).
  rewrite (Rmult_comm (3 * u)); apply Rmult_le_compat_l; [apply Rle_0_sqr | assumption].
assert (sums : Rabs (dot r_fl r_fl k - dot r r k) <= 3 * u * dot r r k /\ 0 <= dot r r k).
  clear k3; induction k as [| k [IH pos]]; cbn [dot]; [rewrite Rminus_0_r, Rabs_R0; lra |].
  assert (H := each k); assert (0 <= r k * r k) by apply Rle_0_sqr; split; [| lra].
  replace (_ - _) with ((dot r_fl r_fl k - dot r r k) + (r_fl k * r_fl k - r k * r k)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); lra.
destruct sums as [sums pos]; assert (D := dot_error r_fl r_fl k).
assert (size r_fl r_fl k = dot r_fl r_fl k) by exact (size_square k r_fl); rewrite H in D.
assert (G := grow_few (S k) ltac:(lia)); assert (T := tiny_few k k3).
assert (grow (S k) <= 4.1 * u).
  do 4 (destruct k as [| k]; [unfold grow; cbn [pow]; rewrite u_value; lra |]); lia.
assert (0 <= dot r_fl r_fl k) by (rewrite <- H; apply size_nonneg).
assert (grow (S k) * dot r_fl r_fl k <= 4.1 * u * dot r_fl r_fl k) by (apply Rmult_le_compat_r; lra).
apply Rabs_le_inv in sums; apply Rabs_le_inv in D; rewrite u_value in *; apply Rabs_le; lra.
Qed.
