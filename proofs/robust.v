(* Answers about robustness of graphs, checked (docs/theory/robustness.md: sec:bounds; docs/robustness.md).

   In words. A graph is (r,s)-robust if for every two disjoint nonempty sets S1, S2: all of S1 hear r nodes or more outside of
   S1, or all of S2 outside of S2, or at least s nodes of both together do so outside of their own set.

   `witness_refutes`: two sets that `refutes` accepts prove that a graph is not (r,s)-robust; it is a program that looks at each
   node once. `degree_proves`: if everybody hears at least floor(n/2) + r - 1 others, the graph is (r,s)-robust for every s. *)

From mathcomp Require Import all_ssreflect zify.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section Robust.
Variables (V : finType) (N : V -> {set V}).   (* N v: whom v hears *)

(* The members of S that hear at least r nodes outside of S. *)
Definition reach r (S : {set V}) := [set v in S | r <= #|N v :\: S|].

Definition robust r s := forall S1 S2 : {set V}, S1 != set0 -> S2 != set0 -> [disjoint S1 & S2] ->
  [\/ reach r S1 = S1, reach r S2 = S2 | s <= #|reach r S1| + #|reach r S2|].

Definition refutes r s (S1 S2 : {set V}) :=
  [&& S1 != set0, S2 != set0, [disjoint S1 & S2], reach r S1 != S1, reach r S2 != S2 &
      #|reach r S1| + #|reach r S2| < s].

Theorem witness_refutes r s S1 S2 : refutes r s S1 S2 -> ~ robust r s.
Proof.
move=> /and5P [n1 n2 dis r1 /andP [r2 few]] rob.
by case: (rob S1 S2 n1 n2 dis) => [/eqP E|/eqP E|le]; [rewrite E in r1 | rewrite E in r2 | rewrite ltnNge le in few].
Qed.

(* And every graph that is not robust has such a witness. *)
Theorem refuted_has_witness r s : ~ robust r s -> exists S1 S2, refutes r s S1 S2.
Proof.
move=> not; have [/existsP [S1 /existsP [S2 ok]] | no] := boolP [exists S1, [exists S2, refutes r s S1 S2]].
  by exists S1, S2.
case: not => S1 S2 n1 n2 dis.
have := no; rewrite negb_exists => /forallP /(_ S1); rewrite negb_exists => /forallP /(_ S2).
rewrite /refutes n1 n2 dis /= !negb_and !negbK -leqNgt => /or3P.
by move=> [/eqP | /eqP | ]; [constructor 1 | constructor 2 | constructor 3].
Qed.

(* sec:bounds, "Degrees" *)
Theorem degree_proves r s : 0 < r -> (forall v, v \notin N v) ->
  (forall v, #|V|./2 + r - 1 <= #|N v|) -> robust r s.
Proof.
move=> r0 loopless deg S1 S2 n1 n2 dis.
have all (S : {set V}) : #|S| <= #|V|./2 -> reach r S = S.
  move=> few; apply/setP => v; rewrite inE; case vS : (v \in S) => //=.
  have sub : N v :&: S \subset S :\ v.
    apply/subsetP => u; rewrite !inE => /andP [uN ->]; rewrite andbT.
    by apply: contraTneq uN => ->; exact: loopless.
  have := subset_leq_card sub; have := cardsD1 v S; rewrite vS.
  have := cardsID S (N v); have := deg v; lia.
have : #|S1| + #|S2| <= #|V|.
  by move: dis; rewrite -setI_eq0 => /eqP E; rewrite -cardsUI E cards0 addn0 max_card.
case: (leqP #|S1| #|V|./2) => [few _ | many both]; first by constructor 1; exact: all.
constructor 2; apply: all; lia.
Qed.
End Robust.
