(* Sizes of sets by eigenvalues (docs/theory/robustness.md: sec:spectrum).

   In words. Let edges have no direction, and let lam bound the second eigenvalue of the Laplacian from below: for any numbers w at
   the n nodes, lam (n |w|^2 - (sum w)^2) <= n w'Lw, where w'Lw is the sum of (w u - w v)^2 over the edges. Let each of a nodes A have
   at most q neighbours outside of A and of x others, D, and let at most X edges lead from D to others. Then for each t from 0 to 1

     lam (a (n - a) - 2 t a x + t^2 x (n - x)) <= n (q a + max(0, 1 - 2t) a x + t^2 X).

   In `laplacian` each edge counts twice, once for each of its ends, hence the 2 in `second_eigenvalue`. `two_sets_do_not_fit`: if
   all sets with a content member and x exempt ones have m x nodes or more, and m x1 + m x2 > n whenever x1 + x2 < s, the graph is
   (r,s)-robust. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect zify.
From Closeranks Require Import vectors robust.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Spectrum.
Variables (V : finType) (E : rel V).
Hypothesis both_ways : symmetric E.

Definition edge u v : R := INR (E u v).
Definition edges (X Y : {set V}) : R := sum (u in X) sum (v in Y) edge u v.
Definition square (x : R) := x * x.

(* Each edge twice. *)
Definition laplacian (w : V -> R) : R := \big[Rplus/0]_u \big[Rplus/0]_v (edge u v * square (w u - w v)).
Definition spread (w : V -> R) : R := INR #|V| * (\big[Rplus/0]_u square (w u)) - square (\big[Rplus/0]_u w u).

Lemma edges_sym X Y : edges X Y = edges Y X.
Proof.
rewrite /edges exchange_big /=; apply: eq_bigr => u _; apply: eq_bigr => v _.
by rewrite /edge both_ways.
Qed.

Lemma edge_nonneg u v : 0 <= edge u v.
Proof. exact: pos_INR. Qed.

Lemma edges_nonneg X Y : 0 <= edges X Y.
Proof. by apply: sum_nonneg => u _; apply: sum_nonneg => v _; exact: edge_nonneg. Qed.

Lemma edges_most X Y : edges X Y <= INR #|X| * INR #|Y|.
Proof.
apply: (@Rle_trans _ (\big[Rplus/0]_(u in X) INR #|Y|)); last by rewrite sum_const; apply: Req_le.
apply: sum_le => u _; apply: (@Rle_trans _ (\big[Rplus/0]_(v in Y) 1)).
  by apply: sum_le => v _; rewrite /edge; case: (E u v) => /=; lra.
by rewrite sum_const Rmult_1_r; apply: Req_le.
Qed.

Variables (A D : {set V}).
Hypothesis apart : [disjoint A & D].
Let C := ~: (A :|: D).

Lemma in_three (F : V -> R) : \big[Rplus/0]_u F u = sum (u in A) F u + sum (u in D) F u + sum (u in C) F u.
Proof.
rewrite (bigID (mem A)) /= Rplus_assoc; congr (_ + _).
rewrite (bigID (mem D)) /=; congr (_ + _); apply: eq_bigl => u; rewrite ?inE.
  by case uD : (u \in D); rewrite ?andbF // andbT (disjointFl apart uD).
by rewrite negb_or.
Qed.

Lemma pairs_in_three (F : V -> V -> R) (X : {set V}) : sum (u in X) (\big[Rplus/0]_v F u v) =
  sum (u in X) (sum (v in A) F u v) + sum (u in X) (sum (v in D) F u v) + sum (u in X) (sum (v in C) F u v).
Proof. by rewrite -!sum_add; apply: eq_bigr => u _; rewrite in_three. Qed.

Section Weights.
Variables (t : R).
Let w (u : V) : R := if u \in A then 1 else if u \in D then t else 0.

Lemma w_A u : u \in A -> w u = 1. Proof. by rewrite /w => ->. Qed.
Lemma w_D u : u \in D -> w u = t.
Proof. by move=> uD; rewrite /w uD (disjointFl apart uD). Qed.
Lemma w_C u : u \in C -> w u = 0.
Proof. by rewrite !inE negb_or /w => /andP [/negbTE -> /negbTE ->]. Qed.

Lemma block (X Y : {set V}) c d : (forall u, u \in X -> w u = c) -> (forall v, v \in Y -> w v = d) ->
  sum (u in X) sum (v in Y) (edge u v * square (w u - w v)) = square (c - d) * edges X Y.
Proof.
move=> onX onY; rewrite /edges -sum_scale; apply: eq_bigr => u uX.
by rewrite -sum_scale; apply: eq_bigr => v vY; rewrite (onX u uX) (onY v vY) Rmult_comm.
Qed.

Lemma laplacian_w :
  laplacian w = 2 * (edges A C + square (1 - t) * edges A D + square t * edges D C).
Proof.
rewrite /laplacian in_three !pairs_in_three.
rewrite !(block w_A w_A) !(block w_A w_D) !(block w_A w_C) !(block w_D w_A) !(block w_D w_D) !(block w_D w_C).
rewrite !(block w_C w_A) !(block w_C w_D) !(block w_C w_C).
rewrite (edges_sym D A) (edges_sym C A) (edges_sym C D) /square; ring.
Qed.

Lemma sum_on (F : V -> R) (X : {set V}) c : (forall u, u \in X -> F u = c) -> sum (u in X) F u = INR #|X| * c.
Proof. by move=> on; rewrite (eq_bigr (fun=> c)) // sum_const. Qed.

Let a := INR #|A|.
Let x := INR #|D|.
Let n := INR #|V|.

Lemma spread_w : spread w = a * (n - a) - 2 * t * a * x + t * t * (x * (n - x)).
Proof.
have squares u c : w u = c -> square (w u) = square c by move=> ->.
rewrite /spread !in_three.
rewrite (sum_on w_A) (sum_on w_D) (sum_on w_C).
rewrite (sum_on (fun u uA => squares u 1 (w_A uA))) (sum_on (fun u uD => squares u t (w_D uD))).
rewrite (sum_on (fun u uC => squares u 0 (w_C uC))) /square /a /x /n; ring.
Qed.

Variables (lam q X : R).
Hypothesis second_eigenvalue : forall v, 2 * lam * spread v <= INR #|V| * laplacian v.
Hypothesis content : forall u, u \in A -> sum (v in C) edge u v <= q.
Hypothesis leaving : edges D (~: D) <= X.

Theorem size_bound : 0 <= t <= 1 ->
  lam * (a * (n - a) - 2 * t * a * x + t * t * (x * (n - x))) <=
  n * (q * a + Rmax 0 (1 - 2 * t) * (a * x) + t * t * X).
Proof.
move=> t01; have := second_eigenvalue w; rewrite laplacian_w spread_w -/n.
have AC : edges A C <= q * a.
  rewrite (Rmult_comm q) /a; apply: (@Rle_trans _ (sum (u in A) q)); last by rewrite sum_const; apply: Req_le.
  exact: sum_le.
have DC : edges A D + edges D C <= X.
  apply: Rle_trans leaving; apply: Req_le; rewrite (edges_sym A D) /edges -sum_add.
  apply: eq_bigr => u uD; rewrite [RHS](bigID (mem A)) /=; congr (_ + _); apply: eq_bigl => v; rewrite !inE.
    by case vA : (v \in A); rewrite ?andbF // (disjointFr apart vA).
  by rewrite negb_or andbC.
have AD := edges_most A D; have AD0 := edges_nonneg A D; have DC0 := edges_nonneg D C.
rewrite -/a -/x in AD; rewrite /square.
have n0 : 0 <= n := pos_INR _.
have tX : t * t * (edges A D + edges D C) <= t * t * X by apply: Rmult_le_compat_l => //; nra.
have part : (1 - 2 * t) * edges A D <= Rmax 0 (1 - 2 * t) * (a * x).
  have := Rmax_l 0 (1 - 2 * t); have := Rmax_r 0 (1 - 2 * t).
  move: (Rmax _ _) => m m1 m0; have : m * edges A D <= m * (a * x) by apply: Rmult_le_compat_l.
  nra.
have all : edges A C + (1 - t) * (1 - t) * edges A D + t * t * edges D C <=
  q * a + Rmax 0 (1 - 2 * t) * (a * x) + t * t * X by lra.
move=> low; have := Rmult_le_compat_l n _ _ n0 all; lra.
Qed.
End Weights.
End Spectrum.

(* From sizes to robustness. *)
Section Fit.
Variables (V : finType) (N : V -> {set V}) (r s : nat) (m : nat -> nat).
Hypothesis sizes : forall S : {set V}, S != set0 -> reach N r S != S -> (m #|reach N r S| <= #|S|)%N.
Hypothesis no_room : forall x1 x2, (x1 + x2 < s -> #|V| < m x1 + m x2)%N.

Theorem two_sets_do_not_fit : robust N r s.
Proof.
move=> S1 S2 n1 n2 dis.
have [/eqP -> | r1] := boolP (reach N r S1 == S1); first by constructor 1.
have [/eqP -> | r2] := boolP (reach N r S2 == S2); first by constructor 2.
constructor 3; rewrite leqNgt; apply/negP => few.
have := no_room few; have := sizes n1 r1; have := sizes n2 r2.
have : (#|S1| + #|S2| <= #|V|)%N.
  by move: dis; rewrite -setI_eq0 => /eqP empty; rewrite -cardsUI empty cards0 addn0 max_card.
lia.
Qed.
End Fit.
