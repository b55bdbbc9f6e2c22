(* One robot in one round of W-MSR (docs/theory/agreement.md, "W-MSR").

   In words. Robot i has a value of its own and hears values of others. `trims` says which of them it may keep: it
   discards at most F values below its own and at most F above, and keeps one above (below) its own only after it has
   discarded F that are at least as far out. `averages` says that its new value is a weighted mean of its own and what it
   kept, each weight at least b.

   The one fact that thm:contraction, thm:two-faced and ranks rest on is `pulled_down`: if at most F of those whom i hears
   tell more than M, and i or more than F of those whom it hears have values of at most c, then its new value is at most
   M - b (M - c). `pulled_up` is its mirror image.

   A *view* x of robot i gives for each robot j the value that j told i, and for i its own value. So nothing here asks that
   a robot tells everybody the same. *)

From mathcomp Require Import all_ssreflect all_algebra.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.Theory.
Local Open Scope ring_scope.

Section Round.
Variables (V : finType) (R : realFieldType).

(* Of the robots N that are heard, K are kept. *)
Definition below (i : V) (x : V -> R) (N K : {set V}) := [set j in N :\: K | x j < x i].
Definition above (i : V) (x : V -> R) (N K : {set V}) := [set j in N :\: K | x i < x j].

Record trims (F : nat) (i : V) (x : V -> R) (N K : {set V}) : Prop := Trims {
  kept_heard : K \subset N;
  ties_stay  : forall j, j \in N -> x j = x i -> j \in K;
  few_below  : (#|below i x N K| <= F)%N;
  few_above  : (#|above i x N K| <= F)%N;
  kept_below : forall k, k \in K -> x k < x i ->
    #|below i x N K| = F /\ forall j, j \in below i x N K -> x j <= x k;
  kept_above : forall k, k \in K -> x i < x k ->
    #|above i x N K| = F /\ forall j, j \in above i x N K -> x k <= x j
}.

Record averages (b : R) (i : V) (x : V -> R) (K : {set V}) (w : V -> R) (y : R) : Prop := Averages {
  weights_least : forall j, j \in i |: K -> b <= w j;
  weights_sum   : \sum_(j in i |: K) w j = 1;
  mean          : y = \sum_(j in i |: K) w j * x j
}.

(* y is a new value that W-MSR(F) may give robot i. *)
Definition wmsr_step F b i x (N : {set V}) y :=
  exists K w, trims F i x N K /\ averages b i x K w y.

(* Of the robots N that are heard: who tells more than M, less than M, at most c, at least c. *)
Definition over x (N : {set V}) (M : R) := [set j in N | M < x j].
Definition under x (N : {set V}) (M : R) := [set j in N | x j < M].
Definition upto x (N : {set V}) (c : R) := [set j in N | x j <= c].
Definition from x (N : {set V}) (c : R) := [set j in N | c <= x j].

Lemma below_opp i x N K : below i (fun j => - x j) N K = above i x N K.
Proof. by apply/setP => j; rewrite !inE ltr_opp2. Qed.

Lemma above_opp i x N K : above i (fun j => - x j) N K = below i x N K.
Proof. by apply/setP => j; rewrite !inE ltr_opp2. Qed.

Lemma wmsr_step_opp F b i x N y :
  wmsr_step F b i x N y -> wmsr_step F b i (fun j => - x j) N (- y).
Proof.
move=> [K [w [[sub ties fb fa kb ka] [least sum mean]]]]; exists K, w; split; split=> //.
- by move=> j jN /oppr_inj; exact: ties.
- by rewrite below_opp.
- by rewrite above_opp.
- move=> k kK; rewrite ltr_opp2 below_opp => lt; have [-> ge] := ka k kK lt.
  by split=> // j /ge; rewrite ler_opp2.
- move=> k kK; rewrite ltr_opp2 above_opp => lt; have [-> ge] := kb k kK lt.
  by split=> // j /ge; rewrite ler_opp2.
- by rewrite mean -sumrN; apply: eq_bigr => j _; rewrite mulrN.
Qed.

Section Down.
Variables (F : nat) (b : R) (i : V) (x : V -> R) (N : {set V}) (y : R).
Hypothesis b0 : 0 <= b.
Variables (K : {set V}) (w : V -> R).
Hypotheses (tr : trims F i x N K) (av : averages b i x K w y).
Variable M : R.
Hypothesis own : x i <= M.
Hypothesis few : (#|over x N M| <= F)%N.

(* What is kept is not above M: else F + 1 of those who are heard would be. *)
Lemma kept_le k : k \in K -> x k <= M.
Proof.
move=> kK; rewrite leNgt; apply/negP => big.
have [cardU geU] := kept_above tr kK (le_lt_trans own big).
have sub : k |: above i x N K \subset over x N M.
  apply/subsetP => j; rewrite in_setU1 => /orP [/eqP -> | jU].
    by rewrite inE big (subsetP (kept_heard tr)).
  have jN : j \in N by move: jU; rewrite !inE => /andP [/andP [_]].
  by rewrite inE jN (lt_le_trans big (geU _ jU)).
have kU : k \notin above i x N K by rewrite !inE kK.
by have := leq_trans (subset_leq_card sub) few; rewrite cardsU1 kU cardU add1n ltnn.
Qed.

Lemma averaged_le k : k \in i |: K -> x k <= M.
Proof. by rewrite in_setU1 => /orP [/eqP -> | /kept_le]. Qed.

Lemma average_le k c : k \in i |: K -> x k <= c -> c <= M -> y <= M - b * (M - c).
Proof.
move=> kK xc cM; rewrite (mean av).
have -> : \sum_(j in i |: K) w j * x j = M - \sum_(j in i |: K) w j * (M - x j).
  rewrite -[X in X - _]mul1r -(weights_sum av) mulr_suml -sumrB; apply: eq_bigr => j _.
  by rewrite mulrBr opprB addrC subrK.
rewrite ler_sub // (bigD1 k) //=; apply: ler_paddr.
  apply: sumr_ge0 => j /andP [jK _]; apply: mulr_ge0; last by rewrite subr_ge0 averaged_le.
  exact: le_trans b0 (weights_least av jK).
by apply: ler_pmul; rewrite ?subr_ge0 // ?(weights_least av) // ler_sub.
Qed.

Lemma keeps_one_of_many c : x i <= c \/ (F < #|upto x N c|)%N ->
  exists2 k, k \in i |: K & x k <= c.
Proof.
case: (leP (x i) c) => [low _ | hi [// | many]]; first by exists i; rewrite ?setU11.
have /subsetPn [j] : ~~ (upto x N c \subset below i x N K).
  by apply: contraL many => /subset_leq_card h; rewrite -leqNgt (leq_trans h) ?(few_below tr).
rewrite inE => /andP [jN jc] nj; exists j => //; rewrite in_setU1; apply/orP; right.
by apply: contraR nj => jK; rewrite !inE jK jN (le_lt_trans jc hi).
Qed.
End Down.

Theorem pulled_down F b i x N y M c : 0 <= b -> wmsr_step F b i x N y ->
  x i <= M -> (#|over x N M| <= F)%N -> c <= M ->
  x i <= c \/ (F < #|upto x N c|)%N -> y <= M - b * (M - c).
Proof.
move=> b0 [K [w [tr av]]] own few cM many.
by have [k kK xk] := keeps_one_of_many tr many; exact: (average_le b0 tr av own few kK xk cM).
Qed.

(* The new value is not above M either way. *)
Theorem stays_below F b i x N y M : 0 <= b -> wmsr_step F b i x N y ->
  x i <= M -> (#|over x N M| <= F)%N -> y <= M.
Proof.
move=> b0 step own few.
by have := pulled_down b0 step own few (lexx M) (or_introl own); rewrite subrr mulr0 subr0.
Qed.

Theorem pulled_up F b i x N y m c : 0 <= b -> wmsr_step F b i x N y ->
  m <= x i -> (#|under x N m| <= F)%N -> m <= c ->
  c <= x i \/ (F < #|from x N c|)%N -> m + b * (c - m) <= y.
Proof.
move=> b0 /wmsr_step_opp step own few mc many; rewrite -ler_opp2.
have -> : - (m + b * (c - m)) = - m - b * (- m - - c) by rewrite opprD opprK [- m + c]addrC.
apply: (pulled_down b0 step); rewrite ?ler_opp2 //.
- by have -> : over (fun j => - x j) N (- m) = under x N m
    by apply/setP => j; rewrite !inE ltr_opp2.
- have -> : upto (fun j => - x j) N (- c) = from x N c
    by apply/setP => j; rewrite !inE ler_opp2.
  by case: many; [left | right].
Qed.

Theorem stays_above F b i x N y m : 0 <= b -> wmsr_step F b i x N y ->
  m <= x i -> (#|under x N m| <= F)%N -> m <= y.
Proof.
move=> b0 step own few.
by have := pulled_up b0 step own few (lexx m) (or_introl own); rewrite subrr mulr0 addr0.
Qed.

(* The own weight is one of several that add to 1. *)
Lemma least_weight_le1 F b i x N y : 0 <= b -> wmsr_step F b i x N y -> b <= 1.
Proof.
move=> b0 [K [w [_ [least <- _]]]]; rewrite (bigD1 i) ?setU11 //= (le_trans (least i _)) ?setU11 //.
by rewrite ler_addl sumr_ge0 // => j /andP [jK _]; rewrite (le_trans b0) ?least.
Qed.
End Round.
