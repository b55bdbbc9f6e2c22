(* The rows (far') as robots form them, ask them and obey them in doubles, in one tick (crates/core/src/controller/budget/inequality.rs, mod.rs; docs/theory/budget.md, thm:discrete; docs/theory/program.md, sec:holds).

   In words. Robot k has n <= 10,000 neighbours, in up to three dimensions. What is computed of a neighbour j is a gradient, of which no coordinate is wrong by more than dg
   (`gradient_formed`, from slope_rounded.v), a kappa too small by at most dk (`kappa_from_distance`), and what may be spent, too large by at most ds. Robot j forms its row from these by `Row::new`; robot
   k adds the gradients and kappas of all, one after the other, each addition rounded, and forms its own row from the sums. `Row::holds` says yes of what each wants to move, at most rho,
   and each moves by that but for 3 u of each coordinate and 1e-300, u = 2^-53. Gradients are at most G, kappas at most K, what may be spent at most B, no number is larger than 1e9.

   `far_prime_tick_formed`: then the tick takes at most s(max(h_k, 0)) + M e from h_k, also between ticks, with M - 1 the largest share and
   e = ds + 4 u B + n rho (1.75 dg + (85 + 2 n) u G) + n rho^2 (1.02 dk + (55 + 2 n) u K) + 1e-240. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors budget budget_rounded.
From Flocq.Core Require Raux.
From Closeranks Require bend_test_rounded exponential link_rounded slope_max_rounded moves_rounded rounding level_rounded row_formed.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.
Notation u := rounding.u.

(* Coordinates by number, as rounding.v has them. *)
Definition vec_of d (a : nat -> R) : vec d := fun c => a c.
Arguments vec_of d a c : clear implicits.
Lemma dot_vec_of d a b : dot (vec_of d a) (vec_of d b) = rounding.dot a b d.
Proof. by rewrite /dot; elim: d => [|d IH]; rewrite ?big_ord0 ?big_ord_recr //= IH. Qed.
Lemma sum_ord n (f : nat -> R) : \big[Rplus/0]_(i < n) f i = rounding.sum f n.
Proof. by elim: n => [|n IH]; rewrite ?big_ord0 ?big_ord_recr //= IH. Qed.

(* A coordinate of a gradient, slope * offset, from a slope that is wrong by at most e. *)
Lemma gradient_formed (x y slope slope_fl e F reach : R) : 0 <= e <= 1e20 -> 0 <= F <= 1e20 -> 0 <= reach <= 1e9 ->
  Rabs (slope_fl - slope) <= e -> Rabs slope <= F -> Rabs (x - y) <= reach ->
  Rabs (rounding.fl (slope_fl * rounding.fl (x - y)) - slope * (x - y)) <= (1.01 * e + 2.1 * u * F) * reach + 1e-250.
Proof.
move=> e0 F0 r0 wrong size_F size_r; have U := rounding.u_value; have n0 := rounding.eta_pos; have ns := rounding.eta_small; have l := link_rounded.least_small.
have T := slope_max_rounded.least_is; have T30 := T 1e30 ltac:(lra).
have O : Rabs (rounding.fl (x - y) - (x - y)) <= u * reach + rounding.eta.
  have := rounding.fl_error (x - y); have : u * Rabs (x - y) <= u * reach by apply: Rmult_le_compat_l; rewrite ?U; lra.
  lra.
have P := bend_test_rounded.times_near _ _ _ _ _ _ F reach wrong O size_F size_r.
have S : Rabs (slope * (x - y)) <= F * reach by rewrite Rabs_mult; apply: Rmult_le_compat => //; exact: Rabs_pos.
have := rounding.fl_of _ _ _ _ P S; have : 0 <= F * reach by apply: Rmult_le_pos; lra.
have : 0 <= e * reach by apply: Rmult_le_pos; lra.
have : F * rounding.eta <= 1e20 * rounding.eta by apply: Rmult_le_compat_r; lra.
have : e * rounding.eta <= 1e20 * rounding.eta by apply: Rmult_le_compat_r; lra.
rewrite U; lra.
Qed.

Section Formed.
Variables (V : finType) (d : nat) (k : V) (C N : {set V}).
Hypothesis d3 : (d <= 3)%coq_nat.
Hypothesis NC : N \subset C.
(* Positions; what each wants to move, and moves. *)
Variables (x v m : V -> nat -> R) (weight : V -> vec d -> R).
Hypothesis weight_nonneg : forall j r, 0 <= weight j r.
Let place j := vec_of d (x j).
Let move j := vec_of d (m j).
Hypothesis out_of_range : forall j, j \in C -> j \notin N -> weight j (r k place j) = 0.
Variable t : V -> R.
Hypothesis t01 : forall j, 0 <= t j <= 1.
Variables (need : R) (s : R -> R).
Hypothesis s_nonneg : forall b, 0 <= b -> 0 <= s b.
Hypothesis s_mono : forall b c, 0 <= b -> b <= c -> s b <= s c.
Let level := h k C place weight need.
Variables (b share : V -> R).
Hypothesis b_true : forall j, j \in k |: N -> 0 <= b j <= pos level.
Hypothesis shares : forall j, j \in k |: N -> INR #|N| <= share j.
Variable M : R.
Hypothesis most : forall j, j \in k |: N -> share j + 1 <= M.
(* Real gradients, and kappas that are large enough. *)
Variables (g : V -> nat -> R) (kappa : V -> R) (rho : R).
Hypothesis kappa0 : forall j, 0 <= kappa j.
Hypothesis bends : forall j w, j \in N -> sq w <= 4 * (rho * rho) ->
  weight j (plus (r k place j) w) >= weight j (r k place j) + dot (vec_of d (g j)) w - kappa j / 2 * sq w.
Hypothesis moves : forall j, sq (move j) <= rho * rho.

(* As computed: gradients, kappas, what may be spent. *)
Variables (g_fl : V -> nat -> R) (kappa_fl spend_fl : V -> R) (dg dk ds G K B : R).
Hypothesis errors : 0 <= dg <= 1 /\ 0 <= dk <= 1 /\ 0 <= ds.
Hypothesis sizes : 0 < G <= 1e4 /\ 0 <= K <= 1e4 /\ 0 < rho <= 1e6 /\ 0 <= B.
Hypothesis g_near : forall j c, Rabs (g_fl j c - g j c) <= dg.
Hypothesis g_size : forall j c, Rabs (g j c) <= G.
Hypothesis kappa_near : forall j, kappa j <= kappa_fl j + dk /\ 0 <= kappa_fl j <= K.
Hypothesis spend_near : forall j, j \in k |: N -> Rmax (spend_fl j) 0 <= s (b j) / (share j + 1) + ds /\ spend_fl j <= B.
Hypothesis v_range : forall j, rounding.square d (v j) <= rho * rho /\ forall c, Rabs (v j c) <= 1e9.
Hypothesis made_of_v : forall j c, Rabs (m j c - v j c) <= 3 * u * Rabs (v j c) + rounding.least.

(* Each neighbour's row: the gradient with respect to its own place is the other way round. *)
Variable scale : V -> R.
Hypothesis scales : forall j, j \in N -> 1 <= scale j * row_formed.largest (g_fl j) (kappa_fl j) d < 2.
Hypothesis rows : forall j, j \in N -> row_formed.formed_holds d (g_fl j) (v j) (kappa_fl j) (spend_fl j) (scale j).

(* The row of k, from sums in some order. *)
Variable order : seq V.
Hypothesis each_once : perm_eq order (enum N).
Let n := #|N|.
Let at_place i := nth k order i.
Definition own_gradient_fl c := - rounding.sum_fl (fun i => g_fl (at_place i) c) n.
Definition own_kappa_fl := rounding.sum_fl (fun i => kappa_fl (at_place i)) n.
Hypothesis few : (n <= 10000)%coq_nat.
Hypothesis own_scale : 1 <= scale k * row_formed.largest own_gradient_fl own_kappa_fl d < 2.
Hypothesis own_row : row_formed.formed_holds d own_gradient_fl (v k) own_kappa_fl (spend_fl k) (scale k).

Definition tick_wrong := ds + 4 * u * B + INR n * rho * (1.75 * dg + (85 + 2 * INR n) * u * G) + INR n * (rho * rho) * (1.02 * dk + (55 + 2 * INR n) * u * K) + 1e-240.

Lemma sum_of_N f : \big[Rplus/0]_(j in N) f j = rounding.sum (fun i => f (at_place i)) n.
Proof.
rewrite -big_enum -(perm_big _ each_once) (big_nth k) /= big_mkord -sum_ord.
by rewrite (perm_size each_once) -cardE.
Qed.

Lemma n_range : 0 <= INR n <= 10000.
Proof. split; first exact: pos_INR. by have := le_INR _ _ few; rewrite [INR (Nat.of_num_uint _)]INR_IZR_INZ. Qed.

Lemma largest_few (a : nat -> R) c X : 0 <= X -> c <= X -> (forall i, Rabs (a i) <= X) -> row_formed.largest a c d <= X.
Proof. by move=> X0 cX aX; elim: d => //= e IH; apply: Rmax_lub. Qed.

Lemma gradient_sum c : Rabs (own_gradient_fl c - - (\big[Rplus/0]_(j in N) g j c)) <= INR n * (1.002 * dg + 1.001 * u * (INR n * G) + 1e-290).
Proof.
have [nr0 nr1] := n_range; have U := rounding.u_value; have n0 := rounding.eta_pos; have [e0 _] := errors; have [s0 _] := sizes; have T := slope_max_rounded.least_is.
have part i : (i <= n)%coq_nat -> Rabs (rounding.sum (fun i => g (at_place i) c) i) <= INR n * G.
  move=> le; apply: (Rle_trans _ (INR i * G)); last by apply: Rmult_le_compat_r; [lra | exact: le_INR].
  elim: i {le} => [|i IH]; first by rewrite /= Rabs_R0; lra.
  cbn [rounding.sum]; rewrite S_INR; apply: Rle_trans (Rabs_triang _ _) _; have := g_size (at_place i) c; lra.
have nG : 0 <= INR n * G by apply: Rmult_le_pos; lra.
have := rounding.sum_error (fun i => g_fl (at_place i) c) (fun i => g (at_place i) c) dg (INR n * G) ltac:(lra) nG (fun i => g_near (at_place i) c) n part.
rewrite sum_of_N /own_gradient_fl.
have -> : - rounding.sum_fl (fun i => g_fl (at_place i) c) n - - rounding.sum (fun i => g (at_place i) c) n =
  - (rounding.sum_fl (fun i => g_fl (at_place i) c) n - rounding.sum (fun i => g (at_place i) c) n) by ring.
rewrite Rabs_Ropp => le; apply: Rle_trans le _.
have p := level_rounded.power_few n few; have p1 := rounding.power_ge_1 n.
have ns := rounding.eta_small; have l := link_rounded.least_small; have T1 : 1e9 * rounding.eta <= 1e-290.
  apply: Rle_trans (_ : 1000 * rounding.least <= _); first lra.
  rewrite /rounding.least; apply: (Rmult_le_reg_r (IZR (10 ^ 300))); first exact: IZR_lt.
  by rewrite Rmult_assoc Rinv_l; [simpl; lra | exact: not_0_IZR].
have q0 : 0 <= (1 + u) * dg + u * (INR n * G) + rounding.eta by rewrite U; lra.
rewrite Rmult_assoc; apply: Rmult_le_compat_l => //.
apply: (Rle_trans _ (((1 + u) * dg + u * (INR n * G) + rounding.eta) * 1.001)); first exact: Rmult_le_compat_l.
rewrite U; lra.
Qed.

Lemma kappa_sum : 0 <= own_kappa_fl <= INR n * K * (1 + 1e-11) + 1e-290 /\
  0 <= \big[Rplus/0]_(j in N) kappa j <= own_kappa_fl + (INR n * dk + 1.001 * u * K * (INR n * (INR n + 1) / 2) + 1e-290).
Proof.
have [nr0 nr1] := n_range; have U := rounding.u_value; have [_ [e1 _]] := errors; have [_ [K0 _]] := sizes; have T := slope_max_rounded.least_is.
have range i : 0 <= kappa_fl (at_place i) <= K by case: (kappa_near (at_place i)).
have same i : Rabs (kappa_fl (at_place i) - kappa_fl (at_place i)) <= 0 by rewrite Rminus_diag_eq // Rabs_R0; lra.
have := @level_rounded.level_bound (fun i => kappa_fl (at_place i)) (fun i => kappa_fl (at_place i)) 0 K ltac:(lra) ltac:(lra) range same n.
have := @level_rounded.sum_range (fun i => kappa_fl (at_place i)) K range n; rewrite -/own_kappa_fl.
have c0 : 0 <= own_kappa_fl.
  rewrite /own_kappa_fl; elim: (n) => [|i IH] /=; first lra.
  by apply: slope_max_rounded.fl_nonneg; have := range i; lra.
set S := rounding.sum _ n => [] [S0 S1] wrong.
have p := level_rounded.power_few n few; have p1 := rounding.power_ge_1 n; have l0 := slope_max_rounded.least_pos.
have X0 : 0 <= INR n * 0 + u * K * (INR n * (INR n + 1) / 2) + INR n * rounding.least.
  have : 0 <= u * K * (INR n * (INR n + 1) / 2) by apply: Rmult_le_pos; [apply: Rmult_le_pos; rewrite ?U; lra | nra].
  have : 0 <= INR n * rounding.least by apply: Rmult_le_pos; lra.
  lra.
have {}wrong : Rabs (own_kappa_fl - S) <= 1.001 * (u * K * (INR n * (INR n + 1) / 2)) + 1e-290.
  apply: Rle_trans wrong _; apply: Rle_trans (_ : 1.001 * (INR n * 0 + u * K * (INR n * (INR n + 1) / 2) + INR n * rounding.least) <= _).
    exact: Rmult_le_compat_r.
  have : INR n * rounding.least <= 10000 * rounding.least by apply: Rmult_le_compat_r; lra.
  have : 20000 * rounding.least <= 1e-290.
    rewrite /rounding.least; apply: (Rmult_le_reg_r (IZR (10 ^ 300))); first exact: IZR_lt.
    by rewrite Rmult_assoc Rinv_l; [simpl; lra | exact: not_0_IZR].
  lra.
have nK : 0 <= INR n * K by apply: Rmult_le_pos; lra.
have grow : u * K * (INR n * (INR n + 1) / 2) <= 5e-12 * (INR n * K).
  have : INR n * (INR n * K) <= 10000 * (INR n * K) by apply: Rmult_le_compat_r; lra.
  rewrite U; lra.
have k_sum : \big[Rplus/0]_(j in N) kappa j <= S + INR n * dk.
  rewrite sum_of_N /S; elim: (n) => [|i IH]; [by rewrite /=; lra | cbn [rounding.sum]; rewrite S_INR].
  by have [] := kappa_near (at_place i); lra.
have k_pos : 0 <= \big[Rplus/0]_(j in N) kappa j by exact: sum_nonneg.
by have [a1 a2] := Raux.Rabs_le_inv _ _ wrong; lra.
Qed.

Lemma small_square (a : nat -> R) X : 0 <= X -> (forall c, Rabs (a c) <= X) -> rounding.square d a <= 1.7321 * X * (1.7321 * X).
Proof.
move=> X0 small; have := moves_rounded.dot_small a X d small; rewrite -/(rounding.square d a) => le; apply: Rle_trans le _.
have d30 : INR d <= 3 by have := le_INR _ _ d3; rewrite (_ : INR 3 = 3) //; rewrite /=; ring.
have : 0 <= X * X by apply: Rmult_le_pos.
move=> q; have : INR d * (X * X) <= 3 * (X * X) by apply: Rmult_le_compat_r.
lra.
Qed.

Lemma own_row_real : - dot (g_kk N (fun j => vec_of d (g j))) (move k) + kappa_kk N kappa * sq (move k) <= s (b k) / (share k + 1) + tick_wrong.
Proof.
have [nr0 nr1] := n_range; have U := rounding.u_value; have [e0 [e1 e2]] := errors; have [s0 [s1 [s2 s3]]] := sizes.
have [[c0 c1] [kk0 kk1]] := kappa_sum; have [sp sB] := spend_near (setU11 k N).
pose gk c := - \big[Rplus/0]_(j in N) g j c.
have -> : - dot (g_kk N (fun j => vec_of d (g j))) (move k) = rounding.dot gk (m k) d.
  rewrite -[g_kk _ _]/(vec_of d (fun c => \big[Rplus/0]_(j in N) g j c)) dot_vec_of /gk.
  by elim: d => [|e IH]; cbn [rounding.dot]; lra.
have -> : sq (move k) = rounding.square d (m k) by rewrite /sq dot_vec_of.
rewrite /kappa_kk.
have nG : 0 <= INR n * G by apply: Rmult_le_pos; lra.
have nG1 : INR n * G <= 10000 * 1e4 by apply: Rmult_le_compat; lra.
have nK : 0 <= INR n * K by apply: Rmult_le_pos; lra.
have nK1 : INR n * K <= 10000 * 1e4 by apply: Rmult_le_compat; lra.
have gk_size c : Rabs (gk c) <= INR n * G.
  rewrite Rabs_Ropp sum_of_N; elim: (n) => [|i IH]; first by rewrite /= Rabs_R0; lra.
  cbn [rounding.sum]; rewrite S_INR; apply: Rle_trans (Rabs_triang _ _) _; have := g_size (at_place i) c; lra.
pose dG := INR n * (1.002 * dg + 1.001 * u * (INR n * G) + 1e-290).
have inner : 0 <= 1.002 * dg + 1.001 * u * (INR n * G) + 1e-290 <= 1.1 by rewrite U; lra.
have dG0 : 0 <= dG by apply: Rmult_le_pos; lra.
have dG1 : dG <= 10000 * 1.1 by apply: Rmult_le_compat; lra.
pose dK := INR n * dk + 1.001 * u * K * (INR n * (INR n + 1) / 2) + 1e-290.
have nnK : 0 <= INR n * (INR n * K) <= 10000 * (INR n * K) by split; [apply: Rmult_le_pos | apply: Rmult_le_compat_r]; lra.
have ndk : 0 <= INR n * dk <= 10000 * 1 by split; [apply: Rmult_le_pos | apply: Rmult_le_compat]; lra.
have dK0 : 0 <= dK <= 1e9 by rewrite /dK U; lra.
have near c : Rabs (own_gradient_fl c - gk c) <= dG by exact: gradient_sum.
have own_small c : Rabs (own_gradient_fl c) <= 1e9.
  have -> : own_gradient_fl c = gk c + (own_gradient_fl c - gk c) by ring.
  by apply: Rle_trans (Rabs_triang _ _) _; have := gk_size c; have := near c; lra.
have big : rounding.square d gk <= (1.7321 * (INR n * G) + 1e-250) * (1.7321 * (INR n * G) + 1e-250).
  by apply: Rle_trans (small_square nG gk_size) _; apply: Rmult_le_compat; lra.
have la : row_formed.largest own_gradient_fl own_kappa_fl d <= 1e9 by apply: largest_few; [lra | lra | exact: own_small].
have gs c : Rabs (gk c) <= 1e9 by have := gk_size c; lra.
have cr0 : 0 <= own_kappa_fl <= 1e9 by lra.
have Gp : 0 < 1.7321 * (INR n * G) + 1e-250 by lra.
have := @row_formed.formed_row_real d own_gradient_fl gk (v k) (m k) own_kappa_fl (spend_fl k) (scale k) (\big[Rplus/0]_(j in N) kappa j) dG dK
  (1.7321 * (INR n * G) + 1e-250) rho d3 cr0 own_scale la (proj2 (v_range k)) gs (made_of_v k) s2 (proj1 (v_range k)) Gp big (conj dG0 dK0) near (conj kk0 kk1) own_row.
move=> row; apply: Rle_trans row _; rewrite /row_formed.row_wrong /tick_wrong.
have mB : Rmax (spend_fl k) 0 <= B by apply: Rmax_lub; lra.
have rr : 0 <= rho * rho <= 1e6 * 1e6 by split; [exact: Rle_0_sqr | apply: Rmult_le_compat; lra].
have cr : own_kappa_fl * (rho * rho) <= (INR n * K * (1 + 1e-11) + 1e-290) * (rho * rho) by apply: Rmult_le_compat_r; lra.
have nr : 0 <= INR n * rho <= 10000 * 1e6 by split; [apply: Rmult_le_pos | apply: Rmult_le_compat]; lra.
have nrr : 0 <= INR n * (rho * rho) <= 10000 * (1e6 * 1e6) by split; [apply: Rmult_le_pos | apply: Rmult_le_compat]; lra.
have m1 : 0 <= INR n * rho * dg by apply: Rmult_le_pos; lra.
have m2 : 0 <= INR n * rho * G by apply: Rmult_le_pos; lra.
have m3 : 0 <= INR n * rho * (INR n * G) by apply: Rmult_le_pos; lra.
have m4 : 0 <= INR n * (rho * rho) * K by apply: Rmult_le_pos; lra.
have m5 : 0 <= INR n * (rho * rho) * (INR n * K) by apply: Rmult_le_pos; lra.
have m6 : 0 <= INR n * (rho * rho) * dk by apply: Rmult_le_pos; lra.
rewrite /dG /dK U; lra.
Qed.

Lemma row_real j : j \in N -> dot (vec_of d (g j)) (move j) + kappa j * sq (move j) <= s (b j) / (share j + 1) + tick_wrong.
Proof.
move=> jN; have jN' : j \in k |: N by rewrite in_setU1 jN orbT.
have [nr0 nr1] := n_range; have U := rounding.u_value; have [e0 [e1 e2]] := errors; have [s0 [s1 [s2 s3]]] := sizes; have [sp sB] := spend_near jN'.
have n1 : 1 <= INR n by apply: (le_INR 1); apply/leP; rewrite /n card_gt0; apply/set0Pn; exists j.
rewrite dot_vec_of (_ : sq (move j) = rounding.square d (m j)); last by rewrite /sq dot_vec_of.
have [kn k0] := kappa_near j.
have gs c : Rabs (g_fl j c) <= 1e9.
  have -> : g_fl j c = g j c + (g_fl j c - g j c) by ring.
  by apply: Rle_trans (Rabs_triang _ _) _; have := g_size j c; have := g_near j c; lra.
have la : row_formed.largest (g_fl j) (kappa_fl j) d <= 1e9 by apply: largest_few; [lra | lra | exact: gs].
have gs' c : Rabs (g j c) <= 1e9 by have := g_size j c; lra.
have kr : 0 <= kappa_fl j <= 1e9 by lra.
have Gp : 0 < 1.7321 * G by lra.
have G0 : 0 <= G by lra.
have er : 0 <= dg /\ 0 <= dk <= 1e9 by lra.
have := @row_formed.formed_row_real d (g_fl j) (g j) (v j) (m j) (kappa_fl j) (spend_fl j) (scale j) (kappa j) dg dk
  (1.7321 * G) rho d3 kr (scales jN) la (proj2 (v_range j)) gs' (made_of_v j) s2 (proj1 (v_range j)) Gp (small_square G0 (g_size j)) er (g_near j) (conj (kappa0 j) kn) (rows jN).
move=> row; apply: Rle_trans row _; rewrite /row_formed.row_wrong /tick_wrong.
have mB : Rmax (spend_fl j) 0 <= B by apply: Rmax_lub; lra.
have rr : 0 <= rho * rho by exact: Rle_0_sqr.
have up a : 0 <= a -> a <= INR n * a by move=> a0; rewrite -{1}(Rmult_1_l a); apply: Rmult_le_compat_r.
have m0 : 0 <= rho * G by apply: Rmult_le_pos; lra.
have m1' : 0 <= rho * dg by apply: Rmult_le_pos; lra.
have m1 := up _ m1'; have m2 := up _ m0.
have m3 : 0 <= INR n * (INR n * (rho * G)) by apply: Rmult_le_pos; lra.
have k1 : kappa_fl j * (rho * rho) <= K * (rho * rho) by apply: Rmult_le_compat_r; lra.
have m4' : 0 <= rho * rho * K by apply: Rmult_le_pos; lra.
have m4 := up _ m4'; have m5 : 0 <= INR n * (INR n * (rho * rho * K)) by apply: Rmult_le_pos; lra.
have m6' : 0 <= rho * rho * dk by apply: Rmult_le_pos; lra.
have m6 := up _ m6'; rewrite U; lra.
Qed.

Theorem far_prime_tick_formed : h' k C place move weight t need >= level - (s (pos level) + M * tick_wrong).
Proof.
have [nr0 nr1] := n_range; have U := rounding.u_value; have [e0 [e1 e2]] := errors; have [s0 [s1 [s2 s3]]] := sizes.
have e_nonneg : 0 <= tick_wrong.
  have nr : 0 <= INR n * rho by apply: Rmult_le_pos; lra.
  have nrr : 0 <= INR n * (rho * rho) by apply: Rmult_le_pos; [lra | exact: Rle_0_sqr].
  have a : 0 <= (85 + 2 * INR n) * u * G by apply: Rmult_le_pos; [apply: Rmult_le_pos; rewrite ?U; lra | lra].
  have c : 0 <= (55 + 2 * INR n) * u * K by apply: Rmult_le_pos; [apply: Rmult_le_pos; rewrite ?U; lra | lra].
  have p : 0 <= INR n * rho * (1.75 * dg + (85 + 2 * INR n) * u * G) by apply: Rmult_le_pos; lra.
  have q : 0 <= INR n * (rho * rho) * (1.02 * dk + (55 + 2 * INR n) * u * K) by apply: Rmult_le_pos; lra.
  have r : 0 <= 4 * u * B by apply: Rmult_le_pos; rewrite ?U; lra.
  rewrite /tick_wrong; lra.
apply: (@far_prime_tick_rounded V d k C N NC place move weight weight_nonneg out_of_range t t01 need s s_nonneg s_mono b share b_true shares tick_wrong M
  e_nonneg most (fun j => vec_of d (g j)) kappa (rho * rho) kappa0 bends moves own_row_real row_real).
Qed.
End Formed.

(* The paper's eleven robots and weight (R = 3 m, q1 = 2.1, q2 = 0.3), ticks of 5 ms: 2.2e-13. The numbers for dg, dk, G and K follow from the theorems named above. *)
Lemma paper_tick (V : finType) (N : {set V}) : #|N| = 10%N -> 11 * tick_wrong N 0.0107 2.5e-14 2.3e-13 1e-14 2.73 11.4 1 <= 2.2e-13.
Proof. by move=> E; rewrite /tick_wrong E INR_IZR_INZ /= rounding.u_value; lra. Qed.
(* The same team with the weight that `budget` chooses at ticks of 5 ms (q1 = 2.333, q2 = 48.5). *)
Lemma chosen_tick (V : finType) (N : {set V}) : #|N| = 10%N -> 11 * tick_wrong N 0.0107 3.1e-12 4.65e-10 1e-14 38.5 1890 1 <= 1.4e-11.
Proof. by move=> E; rewrite /tick_wrong E INR_IZR_INZ /= rounding.u_value; lra. Qed.
