(* The rows (near) of `links` and `budget` as they are formed, asked and obeyed in doubles, in one tick (crates/core/src/controller/rows.rs, links/rows.rs; docs/theory/budget.md: eq:near, thm:discrete).

   In words. As in held_rounded.v, for the row -2 r.v <= (gamma_c/2) (D - Dd^2)^+ of two robots at most A from each other, with Dd <= A <= 1e6.

   `near_row_real`: it holds in real numbers up to e = 8.5e-16 A^2 + 1.1e-14 A rho + 1e-250.
   `near_tick_rounded`: whatever parts of both moves are done, the squared distance is then at least D - gamma_c (D - Dd^2)^+ - 2 e, so at least the smaller of D and Dd^2, less 2 e.
   What `links` keeps is a billionth above the Delta_d of the settings, which is 2e-9 Delta_d^2 of squared distance. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Closeranks Require Import exponential link_rounded slope_max_rounded moves_rounded rounding row_formed.
Local Open Scope R_scope.

Section OneEnd.
Variables (k : nat) (x y : nat -> R) (Dd gamma rho A scale : R) (v m : nat -> R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis A_range : 1e-3 <= A <= 1e6.
Hypothesis Dd_range : 0 <= Dd <= A.
Hypothesis gamma_range : 0 < gamma <= 1.
Hypothesis rho_range : 0 < rho <= 1e6.
Let r := offset x y.
Let D := distance2 k x y.
Let A2 := A * A.
Hypothesis close : D <= A2.
Hypothesis offset_small : forall d, Rabs (r d) <= A.
Hypothesis v_short : square k v <= rho * rho.
Hypothesis v_small : forall d, Rabs (v d) <= 1e9.
Hypothesis made_of_v : forall d, Rabs (m d - v d) <= 3 * u * Rabs (v d) + least.

(* 0.5 * gamma_c * larger(D - Dd^2, 0); the factor -2 is exact. *)
Definition near_bound_fl := fl (fl (/ 2 * gamma) * Rmax (fl (distance2_fl k x y - fl (Dd * Dd))) 0).
Definition near_normal d := -2 * offset_fl x y d.
Definition near_row_fl := formed_holds k near_normal v 0 near_bound_fl scale.
Hypothesis scale_range : 1 <= scale * largest near_normal 0 k < 2.

Definition near_wrong := 8.5e-16 * (A * A) + 1.1e-14 * (A * rho) + 1e-250.

Lemma A2_is : 1e-6 <= A2 <= 1e12.
Proof. unfold A2; split; [apply Rle_trans with (1e-3 * 1e-3) | apply Rle_trans with (1e6 * 1e6)]; try lra; apply Rmult_le_compat; lra. Qed.

Lemma near_bound_enough : near_bound_fl <= gamma / 2 * Rmax (D - Dd * Dd) 0 + 6.6e-16 * A2 /\ 0 <= near_bound_fl <= 0.51 * A2.
Proof.
assert (U := u_value); assert (n0 := eta_pos); assert (ns := eta_small); assert (l := least_small); assert (l0 := least_pos); assert (aa := A2_is).
assert (P := distance2_nonneg k x y); fold D in P; assert (N := distance2_near k x y k3 doubles); fold D in N; apply near in N.
assert (dd : 0 <= Dd * Dd <= A2) by (unfold A2; split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
assert (Q := fl_error (Dd * Dd)); rewrite (Rabs_pos_eq (Dd * Dd)) in Q by lra; apply near in Q.
assert (t0 : 0 <= Rmax (D - Dd * Dd) 0 <= A2) by (split; [apply Rmax_r | apply Rmax_lub; lra]); assert (t1 := Rmax_l (D - Dd * Dd) 0); set (t := Rmax (D - Dd * Dd) 0) in *.
set (z := distance2_fl k x y - fl (Dd * Dd)) in *; set (top := t + 9.3e-16 * A2).
assert (z1 : z <= top) by (unfold z, top; rewrite U in *; lra).
assert (top0 : 0 <= top) by (unfold top; lra); assert (Z := fl_error top); rewrite (Rabs_pos_eq top) in Z by exact top0; apply near in Z.
assert (s1 : Rmax (fl z) 0 <= t + 1.05e-15 * A2).
  assert (M := fl_mono _ _ z1); apply Rmax_lub; unfold top in *; rewrite U in *; lra.
assert (s0 := Rmax_r (fl z) 0); set (s := Rmax (fl z) 0) in *.
assert (F := fl_error (/ 2 * gamma)); rewrite (Rabs_pos_eq (/ 2 * gamma)) in F by lra; apply near in F.
assert (f0 : 0 <= fl (/ 2 * gamma)) by (apply fl_nonneg; lra); set (g := fl (/ 2 * gamma)) in *; unfold near_bound_fl; fold z g s.
assert (p0 : 0 <= g * s) by (apply Rmult_le_pos; lra).
assert (G := fl_error (g * s)); rewrite (Rabs_pos_eq (g * s)) in G by lra; apply near in G.
assert (gs : g * s <= ((1 + u) * (/ 2 * gamma) + eta) * (t + 1.05e-15 * A2)) by (apply Rmult_le_compat; lra).
assert (a : gamma * t <= 1 * A2) by (apply Rmult_le_compat; lra); assert (a0 : 0 <= gamma * t) by (apply Rmult_le_pos; lra).
assert (c : gamma * A2 <= 1 * A2) by (apply Rmult_le_compat_r; lra); assert (c0 : 0 <= gamma * A2) by (apply Rmult_le_pos; lra).
assert (d : eta * t <= eta * 1e12) by (apply Rmult_le_compat_l; lra); assert (d' : eta * A2 <= eta * 1e12) by (apply Rmult_le_compat_l; lra).
assert (tiny : 1e14 * eta <= 1e-30) by lra.
assert (nonneg : 0 <= fl (g * s)) by (apply fl_nonneg; lra).
rewrite U in *; lra.
Qed.

Theorem near_row_real : near_row_fl -> -2 * dot r m k <= gamma / 2 * Rmax (D - Dd * Dd) 0 + near_wrong.
Proof.
intro H; assert (U := u_value); assert (n0 := eta_pos); assert (ns := eta_small); assert (l := least_small); assert (l0 := least_pos); assert (aa := A2_is).
destruct near_bound_enough as [B [B0 B1]].
assert (wr : forall d, Rabs (near_normal d - -2 * r d) <= 2 * u * A + 2 * eta).
  intro d; assert (F := fl_error (r d)); assert (o := offset_small d); unfold near_normal; change (offset_fl x y d) with (fl (r d)).
  replace (-2 * fl (r d) - -2 * r d) with (-2 * (fl (r d) - r d)) by ring; rewrite Rabs_mult, (Rabs_left1 (-2)) by lra; rewrite U in *; lra.
assert (gs : forall d, Rabs (-2 * r d) <= 1e9).
  intro d; assert (o := offset_small d); rewrite Rabs_mult, (Rabs_left1 (-2)) by lra; lra.
assert (ls : largest near_normal 0 k <= 1e9).
  assert (each : forall d, Rabs (near_normal d) <= 1e9).
    intro d; assert (o := offset_small d); assert (w := wr d); replace (near_normal d) with (-2 * r d + (near_normal d - -2 * r d)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_mult, (Rabs_left1 (-2)) by lra; rewrite U in *; lra.
  clear - each; induction k as [| j IH]; cbn [largest]; [lra | apply Rmax_lub; [apply each | exact IH]].
assert (twice : forall a, dot (fun d => -2 * r d) a k = -2 * dot r a k).
  clear; intro a; induction k as [| j IH]; cbn [dot]; [ring | rewrite IH; ring].
assert (gg : square k (fun d => -2 * r d) <= 2 * A * (2 * A)).
  unfold square; replace (dot (fun d => -2 * r d) (fun d => -2 * r d) k) with (4 * D).
    unfold A2 in *; lra.
  unfold D, distance2; fold r; clear; induction k as [| j IH]; cbn [dot]; [ring | rewrite <- IH; ring].
assert (M := formed_row_real k near_normal (fun d => -2 * r d) v m 0 near_bound_fl scale 0 (2 * u * A + 2 * eta) 0 (2 * A) rho k3 ltac:(lra) scale_range ls v_small gs
  made_of_v rho_range v_short ltac:(lra) gg ltac:(rewrite U; split; lra) wr ltac:(lra) H).
rewrite twice, Rmax_left in M by exact B0; unfold row_wrong in M; rewrite Rmax_left in M by exact B0.
assert (Ar : 0 <= A * rho) by (apply Rmult_le_pos; lra); assert (er : eta * rho <= eta * 1e6) by (apply Rmult_le_compat_l; lra).
assert (T := least_is 1e22 ltac:(lra)); unfold near_wrong; fold A2; rewrite U in *; lra.
Qed.
End OneEnd.

Section Pair.
Variables (k : nat) (x y : nat -> R) (Dd gamma rho A scale scale' : R) (v w mv mw : nat -> R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis A_range : 1e-3 <= A <= 1e6.
Hypothesis Dd_range : 0 <= Dd <= A.
Hypothesis gamma_range : 0 < gamma <= 1.
Hypothesis rho_range : 0 < rho <= 1e6.
Let D := distance2 k x y.
Hypothesis close : D <= A * A.
Hypothesis offset_small : forall d, Rabs (x d - y d) <= A.
Hypothesis short : square k v <= rho * rho /\ square k w <= rho * rho.
Hypothesis small : forall d, Rabs (v d) <= 1e9 /\ Rabs (w d) <= 1e9.
Hypothesis made : forall d, Rabs (mv d - v d) <= 3 * u * Rabs (v d) + least /\ Rabs (mw d - w d) <= 3 * u * Rabs (w d) + least.
Hypothesis scales : 1 <= scale * largest (near_normal x y) 0 k < 2 /\ 1 <= scale' * largest (near_normal y x) 0 k < 2.
Hypothesis rows : near_row_fl k x y Dd gamma scale v /\ near_row_fl k y x Dd gamma scale' w.
Variables t s : R.
Hypothesis parts : 0 <= t <= 1 /\ 0 <= s <= 1.
Definition then_offset c := (x c + t * mv c) - (y c + s * mw c).

Theorem near_tick_rounded : dot then_offset then_offset k >= D - gamma * Rmax (D - Dd * Dd) 0 - 2 * near_wrong rho A.
Proof.
destruct short as [sv sw]; destruct scales as [cv cw]; destruct rows as [hv hw]; destruct parts as [t01 s01].
assert (same : distance2 k y x = D) by (unfold D, distance2, offset; clear; induction k as [| j IH]; cbn [dot]; [reflexivity | rewrite IH; ring]).
assert (ow : forall d, Rabs (offset y x d) <= A) by (intro d; unfold offset; rewrite Rabs_minus_sym; apply offset_small).
assert (E1 := near_row_real k x y Dd gamma rho A scale v mv k3 doubles A_range Dd_range gamma_range rho_range close offset_small sv (fun d => proj1 (small d)) (fun d => proj1 (made d)) cv hv).
assert (E2 := near_row_real k y x Dd gamma rho A scale' w mw k3 (fun d => conj (proj2 (doubles d)) (proj1 (doubles d))) A_range Dd_range gamma_range rho_range
  ltac:(rewrite same; exact close) ow sw (fun d => proj2 (small d)) (fun d => proj2 (made d)) cw hw).
rewrite same in E2; fold D in E1.
assert (turn : dot (offset y x) mw k = - dot (offset x y) mw k).
  unfold offset; clear; induction k as [| j IH]; cbn [dot]; [ring | rewrite IH; ring].
rewrite turn in E2; set (E := gamma / 2 * Rmax (D - Dd * Dd) 0 + near_wrong rho A) in *.
assert (E0 : 0 <= E).
  assert (0 <= gamma / 2 * Rmax (D - Dd * Dd) 0) by (apply Rmult_le_pos; [lra | apply Rmax_r]).
  assert (0 <= A * A) by (apply Rmult_le_pos; lra); assert (0 <= A * rho) by (apply Rmult_le_pos; lra); unfold E, near_wrong; lra.
assert (part : forall q a, 0 <= q <= 1 -> a <= E -> q * a <= E).
  intros q a q01 aE; assert (q * a <= q * E) by (apply Rmult_le_compat_l; lra); assert (q * E <= 1 * E) by (apply Rmult_le_compat_r; lra); lra.
assert (P1 := part t _ t01 E1); assert (P2 := part s _ s01 E2).
assert (grown : dot then_offset then_offset k >= D + 2 * (t * dot (offset x y) mv k) - 2 * (s * dot (offset x y) mw k)).
  unfold D, distance2, then_offset, offset; clear; induction k as [| j IH]; cbn [dot]; [lra |].
  assert (0 <= (t * mv j - s * mw j) * (t * mv j - s * mw j)) by apply Rle_0_sqr; lra.
unfold E in *; lra.
Qed.
End Pair.
