(* What it means in real numbers that a row holds as a robot forms it (crates/core/src/program/balls/row.rs: `Row::new`, `Row::holds`; docs/theory/program.md, sec:holds).

   In words. A controller forms a row n.v + c |v|^2 <= b from numbers that are rounded. `Row::new` multiplies all of it by a factor that brings its largest coefficient
   into [1, 2), each product rounded, and takes 0 for a bound below 0. `Row::holds` says yes of the displacement v. Up to three dimensions; no coordinate of v, no
   coefficient is larger than 1e9; u = 2^-53.

   `formed_means`: then n.v + c |v|^2 <= (1 + 3 u) max(b, 0) + 43 u size + 1e-270, with the size the sum of the absolute values of the terms. No power of two is asked for, so
   it covers a factor whose products are not exact.
   `dot_near`, `square_near_moved`: what follows where n or v is a little wrong. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Closeranks Require Import exponential link_rounded slope_max_rounded moves_rounded rounding.
Local Open Scope R_scope.

(* Vectors of which each coordinate is wrong by at most the part a of itself, and f. *)
Section Near.
Variables (n n0 v : nat -> R) (a f : R).
Hypothesis a0 : 0 <= a.
Hypothesis wrong : forall d, Rabs (n d - n0 d) <= a * Rabs (n0 d) + f.

Lemma dot_near k : Rabs (dot n v k - dot n0 v k) <= a * size n0 v k + f * sum_abs v k.
Proof.
induction k as [| j IH]; cbn [dot size sum_abs]; [rewrite Rminus_0_r, Rabs_R0; lra |]; assert (A := Rabs_triang (dot n v j - dot n0 v j) ((n j - n0 j) * v j)).
replace (dot n v j + n j * v j - (dot n0 v j + n0 j * v j)) with ((dot n v j - dot n0 v j) + (n j - n0 j) * v j) by ring; apply Rle_trans with (1 := A).
assert (Rabs ((n j - n0 j) * v j) <= (a * Rabs (n0 j) + f) * Rabs (v j)) by (rewrite Rabs_mult; apply Rmult_le_compat_r; [apply Rabs_pos | apply wrong]).
rewrite (Rabs_mult (n0 j)); lra.
Qed.

Lemma size_near k : size n v k <= (1 + a) * size n0 v k + f * sum_abs v k.
Proof.
induction k as [| j IH]; cbn [size sum_abs]; [lra |].
assert (W := wrong j); assert (n1 : Rabs (n j) <= (1 + a) * Rabs (n0 j) + f).
  replace (n j) with (n0 j + (n j - n0 j)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra.
assert (Rabs (n j) * Rabs (v j) <= ((1 + a) * Rabs (n0 j) + f) * Rabs (v j)) by (apply Rmult_le_compat_r; [apply Rabs_pos | exact n1]).
rewrite !Rabs_mult; lra.
Qed.
End Near.

Lemma sum_abs_few v B k : (k <= 3)%nat -> 0 <= B -> (forall d, Rabs (v d) <= B) -> 0 <= sum_abs v k <= 3 * B.
Proof.
intros k3 B0 small; assert (S := fun d => Rabs_pos (v d)).
assert (s0 := S 0%nat); assert (s1 := S 1%nat); assert (s2 := S 2%nat).
assert (t0 := small 0%nat); assert (t1 := small 1%nat); assert (t2 := small 2%nat).
destruct k as [| [| [| [| k]]]]; cbn [sum_abs]; try lra; lia.
Qed.

(* Cauchy and Schwarz, of the absolute values. *)
Lemma size_small r v A B k : 0 < A -> 0 < B -> dot r r k <= A * A -> dot v v k <= B * B -> size r v k <= A * B.
Proof.
intros A0 B0 rA vB; assert (H : 2 * (A * B) * size r v k <= B * B * dot r r k + A * A * dot v v k).
  clear rA vB; induction k as [| j IH]; cbn [dot size]; [lra |].
  assert (Q : 0 <= (B * Rabs (r j) - A * Rabs (v j)) * (B * Rabs (r j) - A * Rabs (v j))) by apply Rle_0_sqr.
  assert (sq : forall x, x * x = Rabs x * Rabs x) by (intro x; rewrite <- Rabs_mult, Rabs_pos_eq; [reflexivity | apply Rle_0_sqr]).
  rewrite (sq (r j)), (sq (v j)), Rabs_mult; lra.
assert (AB : 0 < A * B) by (apply Rmult_lt_0_compat; assumption).
assert (B * B * dot r r k <= B * B * (A * A)) by (apply Rmult_le_compat_l; [apply Rle_0_sqr | exact rA]).
assert (A * A * dot v v k <= A * A * (B * B)) by (apply Rmult_le_compat_l; [apply Rle_0_sqr | exact vB]).
apply Rmult_le_reg_l with (2 * (A * B)); lra.
Qed.

(* A move that is made of v: over the length of a tick and times it again, and cut to the box. *)
Lemma square_near_moved m v k : (k <= 3)%nat -> (forall d, Rabs (v d) <= 1e9) -> (forall d, Rabs (m d - v d) <= 3 * u * Rabs (v d) + least) ->
  square k m <= (1 + 7 * u) * square k v + 1e11 * least.
Proof.
intros k3 small wrong; assert (U := u_value); assert (l := least_small); assert (l0 := least_pos).
assert (each : forall d, m d * m d <= (1 + 7 * u) * (v d * v d) + 1e10 * least).
  intro d; assert (W := wrong d); assert (s := small d); assert (p := Rabs_pos (v d)).
  assert (m1 : Rabs (m d) <= (1 + 3 * u) * Rabs (v d) + least).
    replace (m d) with (v d + (m d - v d)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra.
  assert (sq : forall x, x * x = Rabs x * Rabs x) by (intro x; rewrite <- Rabs_mult, Rabs_pos_eq; [reflexivity | apply Rle_0_sqr]).
  rewrite (sq (m d)), (sq (v d)); set (y := Rabs (v d)) in *; apply Rle_trans with (((1 + 3 * u) * y + least) * ((1 + 3 * u) * y + least)).
    apply Rmult_le_compat; try apply Rabs_pos; exact m1.
  assert (y * least <= 1e9 * least) by (apply Rmult_le_compat_r; lra); assert (least * least <= 1 * least) by (apply Rmult_le_compat_r; lra).
  assert (0 <= y * y) by (apply Rmult_le_pos; lra); rewrite U; lra.
unfold square; assert (e0 := each 0%nat); assert (e1 := each 1%nat); assert (e2 := each 2%nat).
destruct k as [| [| [| [| k]]]]; cbn [dot]; try lra; lia.
Qed.

Section Formed.
Variables (k : nat) (n v : nat -> R) (c b scale : R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis c0 : 0 <= c.
Fixpoint largest j := match j with O => c | S j => Rmax (Rabs (n j)) (largest j) end.
Hypothesis scale_range : 1 <= scale * largest k < 2.
Hypothesis largest_small : largest k <= 1e9.
Hypothesis v_small : forall d, Rabs (v d) <= 1e9.
(* `Row::new`, then `Row::holds`. *)
Definition formed_holds := holds k (fun d => fl (scale * n d)) v (fl (scale * c)) (Rmax (fl (scale * b)) 0).

Lemma largest_above j : 0 <= largest j /\ c <= largest j.
Proof.
induction j as [| j [IH IH']]; cbn [largest]; [lra |]; assert (H := Rmax_r (Rabs (n j)) (largest j)); lra.
Qed.

Theorem formed_means : formed_holds -> dot n v k + c * square k v <= (1 + 3 * u) * Rmax b 0 + 43 * u * row_size k n v c + 1e-270.
Proof.
intro H; assert (U := u_value); assert (n0 := eta_pos); assert (ns := eta_small); assert (l0 := least_pos); destruct (largest_above k) as [L0 Lc].
assert (pos : 0 < scale).
  destruct (Rlt_le_dec 0 scale) as [y | no]; [exact y | exfalso].
  assert (- scale * largest k >= 0) by (apply Rle_ge, Rmult_le_pos; lra); lra.
assert (sc : 0 <= scale * c <= 2).
  split; [apply Rmult_le_pos; lra | apply Rle_trans with (scale * largest k); [apply Rmult_le_compat_l; lra | lra]].
assert (c2 : 0 <= fl (scale * c) <= 2).
  split; [apply fl_nonneg; lra | rewrite <- (fl_whole 2) by reflexivity; apply fl_mono; lra].
assert (M := holds_means k _ v _ _ k3 c2 (Rmax_r _ _) H); unfold row_size in *; clear H.
assert (wrong : forall d, Rabs (fl (scale * n d) - scale * n d) <= u * Rabs (scale * n d) + eta) by (intro d; apply fl_error).
assert (Dn := dot_near (fun d => fl (scale * n d)) (fun d => scale * n d) v u eta wrong k).
assert (Sn := size_near (fun d => fl (scale * n d)) (fun d => scale * n d) v u eta wrong k).
assert (dot_scale : dot (fun d => scale * n d) v k = scale * dot n v k).
  clear; induction k as [| j IH]; cbn [dot]; [ring | rewrite IH; ring].
assert (size_scale : size (fun d => scale * n d) v k = scale * size n v k).
  clear - pos; induction k as [| j IH]; cbn [size]; [ring | rewrite IH, Rmult_assoc, Rabs_mult, (Rabs_pos_eq scale) by lra; ring].
rewrite dot_scale, size_scale in Dn; rewrite size_scale in Sn; apply near in Dn.
assert (F := fl_error (scale * c)); rewrite (Rabs_pos_eq (scale * c)) in F by lra; apply near in F.
assert (S1 := sum_abs_few v 1e9 k k3 ltac:(lra) v_small).
assert (W0 := square_nonneg k v); assert (W1 : square k v <= 3e18).
  assert (B := dot_small v 1e9 k v_small); unfold square; assert (K : INR k <= 3) by (replace 3 with (INR 3) by (simpl; lra); apply le_INR; exact k3); lra.
assert (N := fl_error (scale * b)); assert (bm : Rmax (fl (scale * b)) 0 <= (1 + u) * (scale * Rmax b 0) + eta).
  assert (B0 := Rmax_r b 0); assert (B1 := Rmax_l b 0); assert (p : 0 <= scale * Rmax b 0) by (apply Rmult_le_pos; lra).
  assert (up : fl (scale * b) <= fl (scale * Rmax b 0)) by (apply fl_mono, Rmult_le_compat_l; lra).
  assert (G := fl_error (scale * Rmax b 0)); rewrite (Rabs_pos_eq (scale * Rmax b 0)) in G by lra; apply near in G.
  apply Rmax_lub; rewrite U in *; lra.
assert (q0 : 0 <= scale * Rmax b 0) by (apply Rmult_le_pos; [lra | apply Rmax_r]).
set (W := square k v) in *; set (S := size n v k) in *; set (A := sum_abs v k) in *; set (B := Rmax b 0) in *.
assert (s0 : 0 <= scale * S) by (apply Rmult_le_pos; [lra | apply size_nonneg]).
assert (cW : (fl (scale * c) - scale * c) * W <= (u * (scale * c) + eta) * W) by (apply Rmult_le_compat_r; lra).
assert (cW' : - (u * (scale * c) + eta) * W <= (fl (scale * c) - scale * c) * W) by (apply Rmult_le_compat_r; lra).
assert (sW : 0 <= scale * c * W) by (apply Rmult_le_pos; lra).
assert (nA : eta * A <= eta * 3e9) by (apply Rmult_le_compat_l; lra); assert (nW : eta * W <= eta * 3e18) by (apply Rmult_le_compat_l; lra).
assert (nA0 : 0 <= eta * A) by (apply Rmult_le_pos; lra); assert (nW0 : 0 <= eta * W) by (apply Rmult_le_pos; lra).
assert (T := least_is 1e22 ltac:(lra)).
assert (one : 1 * (1e13 * least) <= scale * 1e9 * (1e13 * least)).
  apply Rmult_le_compat_r; [lra |]; apply Rle_trans with (scale * largest k); [lra | apply Rmult_le_compat_l; lra].
assert (room : 1e13 * least <= scale * 1e-270).
  assert (scale * (1e22 * least) <= scale * 1e-270) by (apply Rmult_le_compat_l; lra); lra.
apply Rmult_le_reg_l with (1 := pos); rewrite U in *; lra.
Qed.
End Formed.

(* The same row from real numbers: a gradient g of which each computed coordinate is wrong by at most dg, a curvature kappa of at most c + dk, and the move m that is made of v. *)
Section Real.
Variables (k : nat) (n g v m : nat -> R) (c b scale kappa dg dk G rho : R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis c0 : 0 <= c <= 1e9.
Hypothesis scale_range : 1 <= scale * largest n c k < 2.
Hypothesis largest_small : largest n c k <= 1e9.
Hypothesis v_small : forall d, Rabs (v d) <= 1e9.
Hypothesis g_small : forall d, Rabs (g d) <= 1e9.
Hypothesis made_of_v : forall d, Rabs (m d - v d) <= 3 * u * Rabs (v d) + least.
Hypothesis rho_range : 0 < rho <= 1e6.
Hypothesis v_short : square k v <= rho * rho.
Hypothesis G_pos : 0 < G.
Hypothesis g_short : square k g <= G * G.
Hypothesis errors : 0 <= dg /\ 0 <= dk <= 1e9.
Hypothesis gradient_wrong : forall d, Rabs (n d - g d) <= dg.
Hypothesis kappa_low : 0 <= kappa <= c + dk.

Definition row_wrong b c G dg dk rho := 3 * u * Rmax b 0 + 47 * u * (G * rho) + 51 * u * (c * (rho * rho)) + 1.74 * dg * rho + 1.01 * dk * (rho * rho) + 1e-260.

Theorem formed_row_real : formed_holds k n v c b scale -> dot g m k + kappa * square k m <= Rmax b 0 + row_wrong b c G dg dk rho.
Proof.
intro H; assert (M := formed_means k n v c b scale k3 (proj1 c0) scale_range largest_small v_small H); clear H.
assert (U := u_value); assert (n0 := eta_pos); assert (ns := eta_small); assert (l := least_small); assert (l0 := least_pos); destruct errors as [dg0 dk0].
assert (wr : forall d, Rabs (n d - g d) <= 0 * Rabs (g d) + dg) by (intro d; rewrite Rmult_0_l, Rplus_0_l; apply gradient_wrong).
assert (d1 := dot_near n g v 0 dg wr k); assert (z1 := size_near n g v 0 dg wr k).
assert (d2 := dot_near m v g (3 * u) least made_of_v k); assert (q := square_near_moved m v k k3 v_small made_of_v).
assert (sg := sum_abs_few g 1e9 k k3 ltac:(lra) g_small).
assert (swap : forall a b : nat -> R, dot a b k = dot b a k /\ size a b k = size b a k).
  clear; intros a b; induction k as [| j [I1 I2]]; cbn [dot size]; [lra | rewrite I1, I2, (Rmult_comm (a j)); lra].
rewrite (proj1 (swap m g)), (proj1 (swap v g)), (proj2 (swap v g)) in d2; apply near in d1; apply near in d2.
assert (S := size_small g v G rho k G_pos ltac:(lra) g_short v_short); assert (S0 := size_nonneg g v k); assert (W0 := square_nonneg k v).
assert (Av : sum_abs v k <= 1.7321 * rho).
  assert (B := sum_abs_small 0 k v v v v k3 v); assert (sqrt (dot v v k) <= rho); [| lra].
  rewrite <- (sqrt_square rho) by lra; apply sqrt_le_1; [exact W0 | apply Rmult_le_pos; lra | exact v_short].
assert (Av0 := sum_abs_few v 1e9 k k3 ltac:(lra) v_small).
unfold row_size, row_wrong in *; set (W := square k v) in *; set (Wm := square k m) in *; set (Z := size g v k) in *; set (A := sum_abs v k) in *; set (Ag := sum_abs g k) in *.
assert (B0 := Rmax_r b 0); assert (nG : least * Ag <= least * 3e9) by (apply Rmult_le_compat_l; lra); assert (nG0 : 0 <= least * Ag) by (apply Rmult_le_pos; lra).
assert (dA : dg * A <= dg * (1.7321 * rho)) by (apply Rmult_le_compat_l; lra); assert (dA0 : 0 <= dg * A) by (apply Rmult_le_pos; lra).
assert (Wm0 : 0 <= Wm) by apply square_nonneg.
assert (kW : kappa * Wm <= (c + dk) * ((1 + 7 * u) * W + 1e11 * least)).
  apply Rle_trans with ((c + dk) * Wm); [apply Rmult_le_compat_r; lra | apply Rmult_le_compat_l; lra].
assert (cW : c * W <= c * (rho * rho)) by (apply Rmult_le_compat_l; lra); assert (cW0 : 0 <= c * W) by (apply Rmult_le_pos; lra).
assert (kr : dk * W <= dk * (rho * rho)) by (apply Rmult_le_compat_l; lra); assert (kr0 : 0 <= dk * W) by (apply Rmult_le_pos; lra).
assert (cl : c * least <= 1e9 * least) by (apply Rmult_le_compat_r; lra); assert (dl : dk * least <= 1e9 * least) by (apply Rmult_le_compat_r; lra).
assert (T := least_is 1e22 ltac:(lra)); assert (Gr : 0 <= G * rho) by (apply Rmult_le_pos; lra).
rewrite U in *; lra.
Qed.
End Real.
