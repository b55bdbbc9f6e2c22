(* The controller budget when rows hold up to rounding (docs/theory/budget.md, thm:discrete; docs/theory/program.md, sec:holds).

   In words. Let every row with (far') be exceeded by at most e, and let all shares be at most M - 1. Then a tick takes at most
   s(max(h_k, 0)) + M e from h_k, also between ticks. With holds_means of rounding.v e is about 40 u times what is in the row. So a
   rounding of rows is not made larger by the theorem, but a team with h_k < 0 may lose M e in every tick. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors budget.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Rounded.
Variables (V : finType) (d : nat) (k : V) (C N : {set V}).
Hypothesis NC : N \subset C.
Variables (x v : V -> vec d) (weight : V -> vec d -> R).
Hypothesis weight_nonneg : forall j r, 0 <= weight j r.
Hypothesis out_of_range : forall j, j \in C -> j \notin N -> weight j (r k x j) = 0.
Variable t : V -> R.
Hypothesis t01 : forall j, 0 <= t j <= 1.
Variables (need : R) (s : R -> R).
Hypothesis s_nonneg : forall b, 0 <= b -> 0 <= s b.
Hypothesis s_mono : forall b c, 0 <= b -> b <= c -> s b <= s c.
Let level := h k C x weight need.
Variables (b share : V -> R).
Hypothesis b_true : forall j, j \in k |: N -> 0 <= b j <= pos level.
Hypothesis shares : forall j, j \in k |: N -> INR #|N| <= share j.
Variables (e M : R).
Hypothesis e_nonneg : 0 <= e.
Hypothesis most : forall j, j \in k |: N -> share j + 1 <= M.
Variables (g : V -> vec d) (kappa : V -> R) (rho2 : R).
Hypothesis kappa0 : forall j, 0 <= kappa j.
Hypothesis bends : forall j w, j \in N -> sq w <= 4 * rho2 ->
  weight j (plus (r k x j) w) >= weight j (r k x j) + dot (g j) w - kappa j / 2 * sq w.
Hypothesis moves : forall j, sq (v j) <= rho2.
Hypothesis own_row : - dot (g_kk N g) (v k) + kappa_kk N kappa * sq (v k) <= s (b k) / (share k + 1) + e.
Hypothesis rows : forall j, j \in N -> dot (g j) (v j) + kappa j * sq (v j) <= s (b j) / (share j + 1) + e.

Theorem far_prime_tick_rounded : h' k C x v weight t need >= level - (s (pos level) + M * e).
Proof.
have step j : j \in k |: N -> s (b j) / (share j + 1) + e <= (s (b j) + M * e) / (share j + 1).
  move=> jN; have n0 := pos_INR #|N|; have le := shares jN; have mo := most jN.
  have p : 0 < share j + 1 by lra.
  have E : (s (b j) + M * e) / (share j + 1) = s (b j) / (share j + 1) + M * e / (share j + 1) by field; lra.
  rewrite E; apply: Rplus_le_compat_l; apply: (Rmult_le_reg_r (share j + 1)) => //.
  have -> : M * e / (share j + 1) * (share j + 1) = M * e by field; lra.
  by rewrite Rmult_comm; apply: Rmult_le_compat_r.
have Me : 0 <= M * e.
  apply: Rmult_le_pos => //; have := most (setU11 k N); have := shares (setU11 k N); have := pos_INR #|N|; lra.
apply: (@far_prime_tick V d k C N NC x v weight weight_nonneg out_of_range t t01 need (fun c => s c + M * e) _ _
  b share b_true shares g kappa rho2) => //.
- by move=> c c0; have := s_nonneg c0; lra.
- by move=> c c' c0 le; have := s_mono c0 le; lra.
- by apply: Rle_trans own_row (step _ _); exact: setU11.
- by move=> j jN; apply: Rle_trans (rows jN) (step _ _); rewrite in_setU1 jN orbT.
Qed.
End Rounded.
