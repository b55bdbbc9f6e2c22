(* Ranks: agreement whose cost does not grow with the team (thm:ranks).

   In words. Each robot has a rank. The robots of rank 0 are the core. In every round each normal robot of the core hears at
   least F + floor(m/2) others of the core, which has m robots, and every other normal robot hears at least 2F + 1 robots
   of lower ranks than its own; at most F of those that a normal robot hears are malicious, and within the core everybody
   tells everybody the same. Then L + 1 rounds, where L is the highest rank of a normal robot, leave at most (1 - b^(L+1)/2) of the spread. Graphs
   and lies may change from round to round. Outside of the core a liar may tell each neighbour something else.

   `ranks_two_faced`: the same if liars of the core have two faces, with F + floor((m - a)/2) normal core neighbours, where a
   of the core are malicious. `contraction_is_rank_0`: thm:contraction is the case L = 0. *)

From mathcomp Require Import all_ssreflect all_algebra zify.
From Closeranks Require Import round agreement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.Theory.
Local Open Scope ring_scope.

Section Ranks.
Variables (V : finType) (R : realFieldType).
Variables (A : {set V}) (F : nat) (b : R).
Hypothesis b0 : 0 <= b.
Variables (N : nat -> V -> {set V}) (view : nat -> V -> V -> R) (y : nat -> V -> R).
Hypothesis rounds : forall p, round A F b (N p) (view p) (y p) (y p.+1).
Variables (rank : V -> nat) (L : nat).
Hypothesis highest : forall i, i \notin A -> (rank i <= L)%N.

Definition core := [set j | rank j == 0%N].
Definition lower p i := [set j in N p i | (rank j < rank i)%N].
Hypothesis enough_lower : forall p i, i \notin A -> (0 < rank i)%N -> (2 * F + 1 <= #|lower p i|)%N.

(* A robot outside of the core hears more than F normal robots of lower ranks. *)
Lemma normal_lower p i : i \notin A -> (0 < rank i)%N -> (F < #|lower p i :\: A|)%N.
Proof.
move=> iA pos; have all := enough_lower p iA pos; have parts := cardsID A (lower p i).
have few : (#|lower p i :&: A| <= F)%N.
  apply: leq_trans (few_liars (rounds p) iA); apply/subset_leq_card/subsetP => j.
  by rewrite !inE => /andP [/andP [-> _] ->].
lia.
Qed.

(* What the core gains in its first round climbs one rank a round. *)
Lemma climbs_down p m M d : within A (y p) m M -> 0 <= b -> b <= 1 -> 0 <= d ->
  (forall i, i \notin A -> i \in core -> y p.+1 i <= M - b * d) ->
  forall t i, i \notin A -> (rank i <= t)%N -> y (p + t).+1 i <= M - b ^+ t.+1 * d.
Proof.
move=> w _ b1 d0 first_round; elim=> [|t IH] i iA le.
  by rewrite addn0 expr1; apply: first_round; rewrite // inE -leqn0.
have w' q : within A (y (p + q)) m M.
  by elim: q => [|q IHq]; [rewrite addn0 | rewrite addnS; exact: (interval b0 (rounds _) IHq)].
rewrite addnS exprS -mulrA.
have -> : M - b * (b ^+ t.+1 * d) = M - b * (M - (M - b ^+ t.+1 * d)) by rewrite subKr.
have cM : M - b ^+ t.+1 * d <= M by rewrite ler_subl_addr ler_addl mulr_ge0 ?exprn_ge0.
have inside := w' t.+1; rewrite addnS in inside.
apply: (falls b0 (rounds (p + t).+1) inside iA cM).
case: (ltnP t (rank i)) => [high | low]; [right | by left; exact: IH].
have pos : (0 < rank i)%N by exact: leq_ltn_trans high.
apply: leq_trans (normal_lower (p + t).+1 iA pos) _; apply/subset_leq_card/subsetP => j.
rewrite !inE => /andP [jA /andP [jN lt]]; rewrite jN (truthful (rounds _) iA jA jN).
by apply: IH => //; rewrite -ltnS; exact: leq_trans lt le.
Qed.

Lemma climbs_up p m M d : within A (y p) m M -> 0 <= b -> b <= 1 -> 0 <= d ->
  (forall i, i \notin A -> i \in core -> m + b * d <= y p.+1 i) ->
  forall t i, i \notin A -> (rank i <= t)%N -> m + b ^+ t.+1 * d <= y (p + t).+1 i.
Proof.
move=> w _ b1 d0 first_round; elim=> [|t IH] i iA le.
  by rewrite addn0 expr1; apply: first_round; rewrite // inE -leqn0.
have w' q : within A (y (p + q)) m M.
  by elim: q => [|q IHq]; [rewrite addn0 | rewrite addnS; exact: (interval b0 (rounds _) IHq)].
rewrite addnS exprS -mulrA.
have -> : m + b * (b ^+ t.+1 * d) = m + b * ((m + b ^+ t.+1 * d) - m) by rewrite [m + _ - m]addrC addKr.
have mc : m <= m + b ^+ t.+1 * d by rewrite ler_addl mulr_ge0 ?exprn_ge0.
have inside := w' t.+1; rewrite addnS in inside.
apply: (rises b0 (rounds (p + t).+1) inside iA mc).
case: (ltnP t (rank i)) => [high | low]; [right | by left; exact: IH].
have pos : (0 < rank i)%N by exact: leq_ltn_trans high.
apply: leq_trans (normal_lower (p + t).+1 iA pos) _; apply/subset_leq_card/subsetP => j.
rewrite !inE => /andP [jA /andP [jN lt]]; rewrite jN (truthful (rounds _) iA jA jN).
by apply: IH => //; rewrite -ltnS; exact: leq_trans lt le.
Qed.

(* The two theorems differ in the part C of the core whose members see each other alike. *)
Lemma ranks_of (C : {set V}) (z : nat -> V -> R) p D :
  (forall i, i \notin A -> i \in core -> i \in C) ->
  (forall i j, i \notin A -> i \in C -> j \in N p i -> j \in C -> view p i j = z p j) ->
  (forall i, i \notin A -> i \in C -> y p i = z p i) ->
  (forall i, i \notin A -> i \in C -> (F + #|C|./2 <= #|N p i :&: C|)%N) ->
  spread A (y p) D -> spread A (y (p + L).+1) ((1 - b ^+ L.+1 / 2%:R) * D).
Proof.
move=> inC alike own deg sp i j iA jA; have b1 := round_least_weight b0 iA (rounds p).
apply: (shrinks (g := b ^+ L.+1) _ sp) => // [|m M w mM]; first exact: exprn_ile1.
have w' q : within A (y (p + q)) m M.
  by elim: q => [|q IHq]; [rewrite addn0 | rewrite addnS; exact: (interval b0 (rounds _) IHq)].
split; first by rewrite -addnS; exact: w'.
have d0 : 0 <= (M - m) / 2%:R by rewrite divr_ge0 ?subr_ge0 ?ler0n.
case: (middle b0 (rounds p) w alike own deg mM) => side; [left | right] => k kA.
  by apply: (climbs_down w b0 b1 d0 _ kA (highest kA)) => l lA lc; apply: side => //; exact: inC.
by apply: (climbs_up w b0 b1 d0 _ kA (highest kA)) => l lA lc; apply: side => //; exact: inC.
Qed.

(* thm:ranks *)
Theorem ranks p D :
  (exists told : V -> R, forall i j, i \notin A -> i \in core -> j \in N p i -> j \in core ->
     view p i j = told j) ->
  (forall i, i \notin A -> i \in core -> (F + #|core|./2 <= #|N p i :&: core|)%N) ->
  spread A (y p) D -> spread A (y (p + L).+1) ((1 - b ^+ L.+1 / 2%:R) * D).
Proof.
move=> [told voice] deg; apply: (@ranks_of core (fun p k => if k \in A then told k else y p k)) => //.
  move=> i j iA iC jN jC; case: ifPn => [_|jA]; first exact: voice.
  exact: (truthful (rounds p) iA jA jN).
by move=> i /negbTE ->.
Qed.

(* thm:ranks, two faces in the core *)
Theorem ranks_two_faced p D :
  (forall i, i \notin A -> i \in core -> (F + #|core :\: A|./2 <= #|N p i :&: (core :\: A)|)%N) ->
  spread A (y p) D -> spread A (y (p + L).+1) ((1 - b ^+ L.+1 / 2%:R) * D).
Proof.
move=> deg; apply: (@ranks_of (core :\: A) y) => //.
- by move=> i iA iC; rewrite inE iA.
- by move=> i j iA _ jN /setDP [_ jA]; exact: (truthful (rounds p) iA jA jN).
- by move=> i iA /setDP [iC _]; exact: deg.
Qed.
End Ranks.

(* thm:contraction is the case in which all ranks are 0. *)
Corollary contraction_is_rank_0 (V : finType) (R : realFieldType) (A : {set V}) F (b : R) N view y :
  0 <= b -> (forall p, round A F b (N p) (view p) (y p) (y p.+1)) -> forall p D,
  one_voice A (N p) (view p) -> (forall i, i \notin A -> (F + #|V|./2 <= #|N p i|)%N) ->
  spread A (y p) D -> spread A (y p.+1) ((1 - b / 2%:R) * D).
Proof.
move=> b0 rounds p D [told voice] deg sp.
have all : core (fun _ : V => 0%N) = setT by apply/setP => j; rewrite !inE.
have := @ranks V R A F b b0 N view y rounds (fun _ => 0%N) 0 _ _ p D.
rewrite addn0 expr1 all; apply=> //.
- by exists told => i j iA _ jN _; exact: voice.
- by move=> i iA _; rewrite cardsT setIT; exact: deg.
Qed.
