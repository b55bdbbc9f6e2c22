(* Who never agrees (docs/theory/robustness.md: sec:groups).

   In words. Liars D tell everybody the same. A *side* S is a set of robots whose honest members hear at most F robots outside of S, its liars being
   in S. If the honest members of a side begin with one value c and its liars tell c, its honest members keep c for ever under W-MSR(F), whatever
   all others do and whatever values they begin with (`keeps`). So two sides keep two values, for any F.

   `no_agreement`: if a graph is not (F+1,F+1)-robust, there are at most F liars and two honest robots that keep any two values that one likes, in every run that
   begins so. Robustness is necessary for W-MSR(F), not only enough. `stay_between`: all other values stay between the least and the greatest of the start if
   liars tell values in between.

   That the groups that the code peels are as large as these liars can keep them is in peel.v, that robustness is enough in sufficient.v. *)

From mathcomp Require Import all_ssreflect all_algebra zify.
From Closeranks Require Import round robust.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.Theory.
Local Open Scope ring_scope.

Section Groups.
Variables (V : finType) (R : realFieldType) (F : nat) (b : R) (N : V -> {set V}).
Hypothesis b0 : 0 <= b.

(* Honest robots hear the truth of each other and apply W-MSR(F), round after round. *)
Definition run (D : {set V}) (y : nat -> V -> R) (view : nat -> V -> V -> R) := forall p i, i \notin D ->
  [/\ view p i i = y p i, forall j, j \in N i -> j \notin D -> view p i j = y p j &
      wmsr_step F b i (view p i) (N i) (y p.+1 i)].

Section Run.
Variables (D : {set V}) (y : nat -> V -> R) (view : nat -> V -> V -> R).
Hypothesis runs : run D y view.

Theorem keeps (S : {set V}) c : (forall i, i \in S -> i \notin D -> (#|N i :\: S| <= F)%N) ->
  (forall p i j, i \notin D -> j \in N i -> j \in S -> j \in D -> view p i j = c) ->
  (forall i, i \in S -> i \notin D -> y 0%N i = c) -> forall p i, i \in S -> i \notin D -> y p i = c.
Proof.
move=> deaf tell start; elim=> [|p IH] i iS iD; first exact: start.
have [own truth step] := runs p iD.
have same j : j \in N i -> j \in S -> view p i j = c.
  by move=> jN jS; have [jD | jD] := boolP (j \in D); [exact: tell | rewrite truth // IH].
have few_over : (#|over (view p i) (N i) c| <= F)%N.
  apply: leq_trans (deaf i iS iD); apply/subset_leq_card/subsetP => j; rewrite !inE => /andP [jN lt].
  by rewrite jN andbT; apply/negP => jS; rewrite same // ltxx in lt.
have few_under : (#|under (view p i) (N i) c| <= F)%N.
  apply: leq_trans (deaf i iS iD); apply/subset_leq_card/subsetP => j; rewrite !inE => /andP [jN lt].
  by rewrite jN andbT; apply/negP => jS; rewrite same // ltxx in lt.
have at_c : view p i i = c by rewrite own IH.
apply/eqP; rewrite eq_le; apply/andP; split.
  by apply: (stays_below b0 step) => //; rewrite at_c.
by apply: (stays_above b0 step) => //; rewrite at_c.
Qed.

Theorem stay_between m M : (forall p i j, i \notin D -> j \in N i -> j \in D -> m <= view p i j <= M) ->
  (forall i, i \notin D -> m <= y 0%N i <= M) -> forall p i, i \notin D -> m <= y p i <= M.
Proof.
move=> tell start; elim=> [|p IH] i iD; first exact: start.
have [own truth step] := runs p iD.
have all j : j \in N i -> m <= view p i j <= M.
  by move=> jN; have [jD | jD] := boolP (j \in D); [exact: tell | rewrite truth // IH].
have /andP [low high] := IH i iD.
have no_over : over (view p i) (N i) M = set0.
  by apply/setP => j; rewrite !inE; apply/negP => /andP [/all /andP [_ le]]; rewrite ltNge le.
have no_under : under (view p i) (N i) m = set0.
  by apply/setP => j; rewrite !inE; apply/negP => /andP [/all /andP [le _]]; rewrite ltNge le.
apply/andP; split.
  by apply: (stays_above b0 step); rewrite ?own // no_under cards0.
by apply: (stays_below b0 step); rewrite ?own // no_over cards0.
Qed.
End Run.

Lemma honest_member r (S D : {set V}) : reach N r S != S -> reach N r S \subset D -> D :&: S \subset reach N r S ->
  exists i, i \in S :\: D.
Proof.
move=> ne sub back; apply/set0Pn; apply: contra ne => /eqP empty.
rewrite eqEsubset; apply/andP; split; first by apply/subsetP => i; rewrite inE => /andP [].
apply/subsetP => i iS; have [iD | iD] := boolP (i \in D); first by apply: (subsetP back); rewrite inE iD.
have both : i \in S :\: D by rewrite inE iD iS.
by rewrite empty inE in both.
Qed.

Theorem no_agreement : ~ robust N F.+1 F.+1 -> exists D S1 S2 : {set V}, exists i1 i2,
  [/\ (#|D| <= F)%N, [disjoint S1 & S2], i1 \in S1 :\: D, i2 \in S2 :\: D &
   forall c1 c2 y view, run D y view ->
     (forall p i j, i \notin D -> j \in N i -> j \in D -> (j \in S1 -> view p i j = c1) /\ (j \in S2 -> view p i j = c2)) ->
     (forall i, i \notin D -> (i \in S1 -> y 0%N i = c1) /\ (i \in S2 -> y 0%N i = c2)) ->
     forall p, y p i1 = c1 /\ y p i2 = c2].
Proof.
move=> not; have [S1 [S2 /and5P [_ _ dis r1 /andP [r2 few]]]] := refuted_has_witness not.
pose D := reach N F.+1 S1 :|: reach N F.+1 S2.
have in_set (S : {set V}) i : i \in reach N F.+1 S -> i \in S by rewrite inE => /andP [].
have apart i : i \in S1 -> i \in S2 -> False by move=> one two; move: dis => /pred0P /(_ i) /=; rewrite one two.
have [i1 h1] : exists i, i \in S1 :\: D.
  apply: honest_member r1 (subsetUl _ _) _; apply/subsetP => i; rewrite in_setI /D.
  by move=> /andP [/setUP [// | /in_set two] one]; case: (apart i one two).
have [i2 h2] : exists i, i \in S2 :\: D.
  apply: honest_member r2 (subsetUr _ _) _; apply/subsetP => i; rewrite in_setI /D.
  by move=> /andP [/setUP [/in_set one | //] two]; case: (apart i one two).
exists D, S1, S2, i1, i2; split=> //.
  by rewrite -ltnS; apply: leq_ltn_trans few; exact: leq_card_setU.
move=> c1 c2 y view runs tell start p.
have deaf (S : {set V}) : reach N F.+1 S \subset D -> forall i, i \in S -> i \notin D -> (#|N i :\: S| <= F)%N.
  move=> sub i iS iD; rewrite leqNgt; apply: contra iD => many; apply: (subsetP sub); rewrite inE iS; exact: many.
move: h1 h2; rewrite !in_setD => /andP [d1 s1] /andP [d2 s2]; split.
  apply: (keeps runs (deaf S1 (subsetUl _ _)) _ _ p s1 d1) => [q i j iD jN jS jD | i iS iD].
    by have [] := tell q i j iD jN jD; auto.
  by have [] := start i iD; auto.
apply: (keeps runs (deaf S2 (subsetUr _ _)) _ _ p s2 d2) => [q i j iD jN jS jD | i iS iD].
  by have [] := tell q i j iD jN jD; auto.
by have [] := start i iD; auto.
Qed.
End Groups.
