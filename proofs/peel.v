(* The groups that are printed where a graph is not robust (docs/theory/robustness.md: sec:cohesive, sec:groups; crates/graph/src/agreement.rs,
   crates/graph/src/search/peel.rs).

   In words. A set S *holds out* with liars L if each of its members hears at most F robots outside of S and L. `peel` is what the Rust function does: it
   looks at one robot after the other and takes out whoever hears more than F outside of what is left and L, until a pass takes out nobody.

   `peel_holds`, `peel_largest`: what is left holds out, and every subset that holds out is within it. So it is the largest one, whatever the order.

   The groups of a witness (S1, S2) with exempt members D: the first is what peeling leaves of all honest robots that are not in S2, with the liars of S1; the second is what it
   leaves of the other honest ones, with the liars of S2. `groups_hold` holds for them: the groups have no robot in common, they have all honest members of S1 and S2 in
   them, and in every run of W-MSR(F) in which they begin with two values and the liars of their sides tell these, they keep them for ever. `groups_largest`: the first
   is the largest set of honest robots outside of S2 that holds out with the liars of S1, the second the largest of what is left with those of S2. `others_move`: every other honest robot
   hears more than F robots outside of itself, either group and its liars.

   A pair of groups with more members in all may exist: the first takes what it can. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Closeranks Require Import round robust groups.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section Peel.
Variables (V : finType) (N : V -> {set V}) (F : nat) (L : {set V}).
Implicit Types S T : {set V}.

Definition holds_out S := forall v, v \in S -> #|N v :\: (S :|: L)| <= F.

Definition take_out S v := if (v \in S) && (F < #|N v :\: (S :|: L)|) then S :\ v else S.
Definition pass S := foldl take_out S (enum V).
Definition peel S := iter #|V| pass S.

Lemma fewer_outside S T v : S \subset T -> #|N v :\: (T :|: L)| <= #|N v :\: (S :|: L)|.
Proof. by move=> sub; apply/subset_leq_card/setDS/setSU. Qed.

Lemma take_out_keeps S T v : holds_out S -> S \subset T -> S \subset take_out T v.
Proof.
move=> hold sub; rewrite /take_out; case: ifP => // /andP [_ many]; apply/subsetP => w wS.
rewrite in_setD1 (subsetP sub) // andbT; apply/negP => /eqP E; rewrite E in wS.
by have := leq_trans (leq_trans many (fewer_outside v sub)) (hold v wS); rewrite ltnn.
Qed.

Lemma take_out_sub T v : take_out T v \subset T.
Proof. by rewrite /take_out; case: ifP => // _; exact: subsetDl. Qed.

Lemma fold_keeps s S T : holds_out S -> S \subset T -> S \subset foldl take_out T s.
Proof. by move=> hold; elim: s T => //= v s IH T sub; apply/IH/take_out_keeps. Qed.

Lemma fold_sub s T : foldl take_out T s \subset T.
Proof. by elim: s T => //= v s IH T; exact: subset_trans (IH _) (take_out_sub T v). Qed.

Lemma fold_same s T : foldl take_out T s = T -> forall v, v \in s -> take_out T v = T.
Proof.
elim: s T => //= w s IH T same v; have E : take_out T w = T.
  by apply/eqP; rewrite eqEsubset take_out_sub -{1}same fold_sub.
by rewrite in_cons => /orP [/eqP -> // | vs]; rewrite E in same; exact: IH same v vs.
Qed.

Lemma same_holds T : pass T = T -> holds_out T.
Proof.
move=> same v vT; have := fold_same same (v := v); rewrite mem_enum => /(_ isT); rewrite /take_out vT /=.
by case: ltnP => // _ E; move: vT; rewrite -E in_setD1 eqxx.
Qed.

Lemma peel_fixed T k : pass (iter k pass T) = iter k pass T \/ #|iter k pass T| + k <= #|T|.
Proof.
elim: k => [|k IH]; first by right; rewrite addn0.
case: IH => [same | le] /=; first by left; rewrite !same.
case: (eqVneq (pass (iter k pass T)) (iter k pass T)) => [same | ne]; first by left; rewrite !same.
right; rewrite addnS -addSn; apply: leq_trans le; rewrite leq_add2r; apply: proper_card.
by rewrite properEneq ne; exact: fold_sub.
Qed.

Theorem peel_holds T : holds_out (peel T).
Proof.
apply: same_holds; case: (peel_fixed T #|V|) => // le.
have empty : peel T = set0.
  apply/eqP; rewrite -cards_eq0 -leqn0 -(leq_add2r #|V|) add0n; exact: leq_trans le (max_card _).
by rewrite -/(peel T) empty; apply/eqP; rewrite -subset0 fold_sub.
Qed.

Theorem peel_largest S T : S \subset T -> holds_out S -> S \subset peel T.
Proof. by move=> sub hold; rewrite /peel; elim: #|V| => //= k IH; exact: fold_keeps. Qed.

Lemma peel_sub T : peel T \subset T.
Proof. by rewrite /peel; elim: #|V| => //= k IH; exact: subset_trans (fold_sub _ _) IH. Qed.

(* Whoever is taken out could not have stayed. *)
Lemma taken_out T v : v \in T -> v \notin peel T -> F < #|N v :\: (v |: (peel T :|: L))|.
Proof.
move=> vT out; rewrite ltnNge; apply/negP => few; move: out; apply/negP/negPn.
apply: (subsetP (@peel_largest (v |: peel T) T _ _)); rewrite ?setU11 //.
  by rewrite subUset sub1set vT peel_sub.
move=> w; rewrite in_setU1 => /orP [/eqP -> | wP]; first by rewrite -setUA.
by apply: leq_trans (fewer_outside w (subsetUr [set v] (peel T))) (peel_holds wP).
Qed.
End Peel.

Section Groups.
Variables (V : finType) (N : V -> {set V}) (F : nat) (S1 S2 : {set V}).
Hypothesis witness : refutes N F.+1 F.+1 S1 S2.
Let D := reach N F.+1 S1 :|: reach N F.+1 S2.
Definition first := peel N F (D :&: S1) (~: S2 :\: D).
Definition second := peel N F (D :&: S2) (~: (first :|: (D :&: S1)) :\: D).

Lemma apart v : v \in S1 -> v \in S2 -> False.
Proof. by have /and5P [_ _ dis _ _] := witness; move=> one two; move: dis => /pred0P /(_ v) /=; rewrite one two. Qed.

(* The honest members of a side hold out with its liars. *)
Lemma side_holds (S : {set V}) : reach N F.+1 S \subset D -> holds_out N F (D :&: S) (S :\: D).
Proof.
move=> sub v; rewrite in_setD => /andP [vD vS].
have -> : S :\: D :|: D :&: S = S by rewrite setUC setIC setID.
by rewrite leqNgt; apply: contra vD => many; apply: (subsetP sub); rewrite inE vS.
Qed.

Theorem groups_largest : (forall S : {set V}, S \subset ~: S2 :\: D -> holds_out N F (D :&: S1) S -> S \subset first) /\
  (forall S : {set V}, S \subset ~: (first :|: (D :&: S1)) :\: D -> holds_out N F (D :&: S2) S -> S \subset second).
Proof. by split=> S; exact: peel_largest. Qed.

Lemma first_in v : v \in first -> v \notin S2 /\ v \notin D.
Proof. by move=> /(subsetP (peel_sub _ _ _ _)); rewrite in_setD in_setC => /andP []. Qed.

Lemma second_in v : v \in second -> v \notin first /\ v \notin D.
Proof. by move=> /(subsetP (peel_sub _ _ _ _)); rewrite in_setD in_setC in_setU negb_or => /and3P []. Qed.

Lemma sides_in : S1 :\: D \subset first /\ S2 :\: D \subset second.
Proof.
split; apply: peel_largest.
- by apply/subsetP => v; rewrite !in_setD in_setC => /andP [-> one] /=; apply/negP; exact: apart.
- exact/side_holds/subsetUl.
- apply/subsetP => v; rewrite in_setD => /andP [vD two]; rewrite in_setD vD in_setC in_setU negb_or in_setI (negbTE vD) andbT /=.
  by apply/negP => /first_in [no _]; rewrite two in no.
- exact/side_holds/subsetUr.
Qed.

Theorem others_move v : v \notin D -> v \notin first -> v \notin second ->
  F < #|N v :\: (v |: (first :|: (D :&: S1)))| /\ F < #|N v :\: (v |: (second :|: (D :&: S2)))|.
Proof.
move=> vD v1 v2; have [_ in2] := sides_in; split; apply: taken_out => //.
  rewrite in_setD vD in_setC; apply: contra v2 => two; apply: (subsetP in2); rewrite in_setD vD; exact: two.
by rewrite in_setD vD in_setC in_setU negb_or v1 in_setI (negbTE vD).
Qed.

Theorem groups_hold (R : realFieldType) (b : R) : (0 <= b)%R ->
  [/\ (#|D| <= F)%N, [disjoint first & second], S1 :\: D \subset first, S2 :\: D \subset second &
   forall (c1 c2 : R) y view, run F b N D y view ->
     (forall p i j, i \notin D -> j \in N i -> j \in D -> (j \in S1 -> view p i j = c1) /\ (j \in S2 -> view p i j = c2)) ->
     (forall i, (i \in first -> y 0 i = c1) /\ (i \in second -> y 0 i = c2)) ->
     forall p i, (i \in first -> y p i = c1) /\ (i \in second -> y p i = c2)].
Proof.
move=> b0; have [in1 in2] := sides_in; split=> //.
- have /and5P [_ _ _ _ /andP [_ few]] := witness; rewrite -ltnS; apply: leq_ltn_trans few; exact: leq_card_setU.
- by apply/pred0P => v /=; apply/negP => /andP [one /second_in [no _]]; rewrite one in no.
move=> c1 c2 y view runs tell start p i; split=> inn.
- apply: (@keeps _ _ F b N b0 D y view runs (first :|: (D :&: S1)) c1 _ _ _ p i); last by case: (first_in inn).
  + by move=> v; rewrite in_setU => /orP [vF _ | ]; [exact: peel_holds vF | rewrite in_setI => /andP [-> _]].
  + move=> q v j vD jN; rewrite in_setU => /orP [/first_in [_ no] jD | ]; first by rewrite jD in no.
    by rewrite in_setI => /andP [_ one] jD; have [h _] := tell q v j vD jN jD; exact: h.
  + by move=> v; rewrite in_setU => /orP [vF _ | ]; [have [h _] := start v; exact: h | rewrite in_setI => /andP [-> _]].
  by rewrite in_setU inn.
- apply: (@keeps _ _ F b N b0 D y view runs (second :|: (D :&: S2)) c2 _ _ _ p i); last by case: (second_in inn).
  + by move=> v; rewrite in_setU => /orP [vF _ | ]; [exact: peel_holds vF | rewrite in_setI => /andP [-> _]].
  + move=> q v j vD jN; rewrite in_setU => /orP [/second_in [_ no] jD | ]; first by rewrite jD in no.
    by rewrite in_setI => /andP [_ two] jD; have [_ h] := tell q v j vD jN jD; exact: h.
  + by move=> v; rewrite in_setU => /orP [vF _ | ]; [have [_ h] := start v; exact: h | rewrite in_setI => /andP [-> _]].
  by rewrite in_setU inn.
Qed.
End Groups.
