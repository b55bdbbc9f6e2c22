(* Agreement (docs/theory/agreement.md: thm:contraction, thm:two-faced).

   In words, thm:contraction: let every normal robot hear at least F + floor(n/2) neighbours in a round of W-MSR(F), at most
   F of them malicious, and let each malicious robot tell all who hear it the same value. Then no normal value leaves the
   interval of the normal values, and their spread D shrinks: D' <= (1 - b/2) D. Graphs and lies may differ from round to
   round, so p rounds leave at most (1 - b/2)^p D.

   thm:two-faced: the same if malicious robots tell each neighbour another value, with F + floor((n - a)/2) normal
   neighbours, a being the number of malicious robots.

   Both are one lemma, `middle`, about a set C of robots that all who are in it see alike: C is everybody in the first
   theorem, the normal robots in the second, and the robots of the lowest rank in ranks.v. *)

From mathcomp Require Import all_ssreflect all_algebra zify.
From Closeranks Require Import round.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.Theory.
Local Open Scope ring_scope.

Section Agreement.
Variables (V : finType) (R : realFieldType).
Variables (A : {set V}) (F : nat) (b : R).   (* malicious robots, F, least weight *)
Hypothesis b0 : 0 <= b.

(* Whom each robot hears, what it hears of whom, values before and after. *)
Record round (N : V -> {set V}) (view : V -> V -> R) (y y' : V -> R) : Prop := Round {
  not_itself : forall i, i \notin A -> i \notin N i;
  few_liars  : forall i, i \notin A -> (#|N i :&: A| <= F)%N;
  own_value  : forall i, i \notin A -> view i i = y i;
  truthful   : forall i j, i \notin A -> j \notin A -> j \in N i -> view i j = y j;
  updated    : forall i, i \notin A -> wmsr_step F b i (view i) (N i) (y' i)
}.

(* Each robot tells all who hear it the same. *)
Definition one_voice (N : V -> {set V}) (view : V -> V -> R) :=
  exists told : V -> R, forall i j, i \notin A -> j \in N i -> view i j = told j.

Definition within (y : V -> R) (m M : R) := forall i, i \notin A -> m <= y i <= M.

(* No two normal values are farther apart than D. *)
Definition spread (y : V -> R) (D : R) := forall i j, i \notin A -> j \notin A -> y i - y j <= D.

Section OneRound.
Variables (N : V -> {set V}) (view : V -> V -> R) (y y' : V -> R).
Hypothesis rd : round N view y y'.
Variables (m M : R).
Hypothesis inside : within y m M.

Lemma few_over i : i \notin A -> (#|over (view i) (N i) M| <= F)%N.
Proof.
move=> iA; apply: leq_trans (few_liars rd iA); apply/subset_leq_card/subsetP => j.
rewrite !inE => /andP [jN big]; rewrite jN; apply: contraLR big => jA.
by rewrite -leNgt (truthful rd iA jA jN); have /andP [] := inside jA.
Qed.

Lemma few_under i : i \notin A -> (#|under (view i) (N i) m| <= F)%N.
Proof.
move=> iA; apply: leq_trans (few_liars rd iA); apply/subset_leq_card/subsetP => j.
rewrite !inE => /andP [jN small]; rewrite jN; apply: contraLR small => jA.
by rewrite -leNgt (truthful rd iA jA jN); have /andP [] := inside jA.
Qed.

(* thm:contraction, first half: M' <= M and m' >= m. It needs no degree. *)
Theorem interval : within y' m M.
Proof.
move=> i iA; have /andP [lo hi] := inside iA; apply/andP; split.
  by apply: (stays_above b0 (updated rd iA)); rewrite ?(own_value rd iA) // few_under.
by apply: (stays_below b0 (updated rd iA)); rewrite ?(own_value rd iA) // few_over.
Qed.

Lemma falls i c : i \notin A -> c <= M ->
  y i <= c \/ (F < #|upto (view i) (N i) c|)%N -> y' i <= M - b * (M - c).
Proof.
move=> iA cM many; have /andP [_ hi] := inside iA.
by apply: (pulled_down b0 (updated rd iA)); rewrite ?(own_value rd iA) ?few_over.
Qed.

Lemma rises i c : i \notin A -> m <= c ->
  c <= y i \/ (F < #|from (view i) (N i) c|)%N -> m + b * (c - m) <= y' i.
Proof.
move=> iA mc many; have /andP [lo _] := inside iA.
by apply: (pulled_up b0 (updated rd iA)); rewrite ?(own_value rd iA) ?few_under.
Qed.

(* A set C whose members see each other alike, and enough of each other. *)
Variables (C : {set V}) (z : V -> R).
Hypothesis alike : forall i j, i \notin A -> i \in C -> j \in N i -> j \in C -> view i j = z j.
Hypothesis alike_own : forall i, i \notin A -> i \in C -> y i = z i.
Hypothesis enough : forall i, i \notin A -> i \in C -> (F + #|C|./2 <= #|N i :&: C|)%N.

(* A robot of a small part S of C hears more than F of C outside of S. *)
Lemma hears_others (S : {set V}) i : i \notin A -> i \in C -> i \in S -> S \subset C ->
  (#|S| <= #|C|./2)%N -> (F < #|(N i :&: C) :\: S|)%N.
Proof.
move=> iA iC iS SC few.
have sub : (N i :&: C) :&: S \subset S :\ i.
  apply/subsetP => j; rewrite in_setI in_setD1 => /andP [/setIP [jN _] ->]; rewrite andbT.
  by apply: contraTneq jN => ->; apply: (not_itself rd iA).
have lt : (#|(N i :&: C) :&: S| < #|C|./2)%N.
  apply: leq_ltn_trans (subset_leq_card sub) _; apply: leq_trans few.
  by rewrite [X in (_ < X)%N](cardsD1 i) iS add1n.
rewrite -(ltn_add2l #|(N i :&: C) :&: S|) cardsID.
by apply: leq_trans (enough iA iC); rewrite addnC ltn_add2l.
Qed.

(* The members of C all come down from M, or all come up from m. *)
Lemma middle : m <= M -> let d := (M - m) / 2%:R in
  (forall i, i \notin A -> i \in C -> y' i <= M - b * d) \/
  (forall i, i \notin A -> i \in C -> m + b * d <= y' i).
Proof.
move=> mM d; pose c := M - d.
have d0 : 0 <= d by rewrite /d divr_ge0 ?subr_ge0 ?ler0n.
have dd : M - m = d + d by rewrite /d -splitr.
have cm : c = m + d by rewrite /c; apply/eqP; rewrite subr_eq -addrA -dd addrC subrK.
have cM : c <= M by rewrite /c ler_subl_addr ler_addl.
have mc : m <= c by rewrite cm ler_addl.
have dM : d = M - c by rewrite /c subKr.
have dm : d = c - m by rewrite cm addrC addKr.
pose hi := [set j in C | c < z j]; pose lo := [set j in C | z j < c].
have disj : (#|hi| + #|lo| <= #|C|)%N.
  rewrite -cardsUI (_ : hi :&: lo = set0) ?cards0 ?addn0; last first.
    by apply/setP => j; rewrite !inE; case: (ltgtP c (z j)); rewrite ?andbF.
  by apply/subset_leq_card/subsetP => j; rewrite !inE => /orP [] /andP [].
have [few | many] := leqP #|hi| #|C|./2; [left | right] => i iA iC.
  rewrite dM; apply: falls => //; case: (leP (y i) c) => [le | gt]; [by left | right].
  have iS : i \in hi by rewrite inE iC -alike_own.
  apply: leq_trans (hears_others iA iC iS _ few) _; first by apply/subsetP => j /setIdP [].
  apply/subset_leq_card/subsetP => j; rewrite !inE => /andP [njS /andP [jN jC]].
  by rewrite jN (alike iA iC jN jC) leNgt; move: njS; rewrite jC.
rewrite dm; apply: rises => //; case: (leP c (y i)) => [le | gt]; [by left | right].
have iS : i \in lo by rewrite inE iC -alike_own.
have few : (#|lo| <= #|C|./2)%N.
  rewrite -(leq_add2l #|hi|); apply: leq_trans disj _.
  rewrite -[X in (X <= _)%N](odd_double_half #|C|) -addnn addnA leq_add2r.
  by apply: leq_trans many; rewrite -add1n leq_add2r leq_b1.
apply: leq_trans (hears_others iA iC iS _ few) _; first by apply/subsetP => j /setIdP [].
apply/subset_leq_card/subsetP => j; rewrite !inE => /andP [njS /andP [jN jC]].
by rewrite jN (alike iA iC jN jC) leNgt; move: njS; rewrite jC.
Qed.
End OneRound.

(* The exact least and greatest normal value, where there is a normal robot at all. *)
Lemma bounds (y : V -> R) i0 : i0 \notin A -> exists m M,
  within y m M /\ (exists2 i, i \notin A & y i = m) /\ (exists2 i, i \notin A & y i = M).
Proof.
move=> iA; have [u uA uM] := @arg_maxP _ _ V i0 (fun i => i \notin A) y iA.
have [l lA lm] := @arg_minP _ _ V i0 (fun i => i \notin A) y iA.
exists (y l), (y u); split; last by split; [exists l | exists u].
by move=> i iA'; apply/andP; split; [exact: lm | exact: uM].
Qed.

Lemma within_spread y m M : within y m M -> spread y (M - m).
Proof.
move=> w i j iA jA; have /andP [_ hi] := w i iA; have /andP [lo _] := w j jA.
by rewrite ler_sub.
Qed.

(* If all normal robots leave one end of the interval by b d, the spread shrinks. *)
Lemma shrinks (g : R) (y y' : V -> R) D : g <= 1 -> spread y D ->
  (forall m M, within y m M -> m <= M -> within y' m M /\
     let d := (M - m) / 2%:R in
     ((forall i, i \notin A -> y' i <= M - g * d) \/ (forall i, i \notin A -> m + g * d <= y' i))) ->
  spread y' ((1 - g / 2%:R) * D).
Proof.
move=> g1 sp step i j iA jA; have [m [M [w [[l lA El] [u uA Eu]]]]] := bounds y iA.
have mM : m <= M by have /andP [h1 h2] := w i iA; exact: le_trans h2.
have [w' side] := step m M w mM.
have small : (1 - g / 2%:R) * (M - m) <= (1 - g / 2%:R) * D.
  apply: ler_wpmul2l; last by rewrite -Eu -El; exact: sp.
  by rewrite subr_ge0 ler_pdivr_mulr ?ltr0n // mul1r (le_trans g1) // ler1n.
apply: le_trans small.
have /andP [loi hii] := w' i iA; have /andP [loj hij] := w' j jA.
have key : (1 - g / 2%:R) * (M - m) = M - m - g * ((M - m) / 2%:R).
  by rewrite mulrBl mul1r mulrAC mulrA.
rewrite key; case: side => side.
  have := ler_sub (side i iA) loj; move/le_trans; apply.
  by rewrite addrAC.
have := ler_sub hii (side j jA); move/le_trans; apply.
by rewrite opprD addrA.
Qed.

Lemma round_least_weight N view y y' i : i \notin A -> round N view y y' -> b <= 1.
Proof. by move=> iA rd; exact: (least_weight_le1 b0 (updated rd iA)). Qed.

(* thm:contraction *)
Theorem contraction N view y y' D : round N view y y' -> one_voice N view ->
  (forall i, i \notin A -> (F + #|V|./2 <= #|N i|)%N) ->
  spread y D -> spread y' ((1 - b / 2%:R) * D).
Proof.
move=> rd [told voice] enough sp i j iA jA; have b1 := round_least_weight iA rd.
apply: (shrinks b1 sp) => // m M w mM; split; first exact: (interval rd w).
pose z k := if k \in A then told k else y k.
have alike k l : k \notin A -> k \in [set: V] -> l \in N k -> l \in [set: V] -> view k l = z l.
  by rewrite /z => kA _ lN _; case: ifPn => [_|lA]; [exact: voice | exact: (truthful rd kA lA lN)].
have own k : k \notin A -> k \in [set: V] -> y k = z k by rewrite /z => /negbTE ->.
have deg k : k \notin A -> k \in [set: V] -> (F + #|[set: V]|./2 <= #|N k :&: [set: V]|)%N.
  by move=> kA _; rewrite cardsT setIT; exact: enough.
by have [h|h] := middle rd w alike own deg mM; [left | right] => k kA; exact: h.
Qed.

(* thm:two-faced *)
Theorem two_faced N view y y' D : round N view y y' ->
  (forall i, i \notin A -> (F + #|~: A|./2 <= #|N i :\: A|)%N) ->
  spread y D -> spread y' ((1 - b / 2%:R) * D).
Proof.
move=> rd enough sp i j iA jA; have b1 := round_least_weight iA rd.
apply: (shrinks b1 sp) => // m M w mM; split; first exact: (interval rd w).
have alike k l : k \notin A -> k \in ~: A -> l \in N k -> l \in ~: A -> view k l = y l.
  by rewrite !inE => kA _ lN lA; exact: (truthful rd kA lA lN).
have deg k : k \notin A -> k \in ~: A -> (F + #|~: A|./2 <= #|N k :&: ~: A|)%N.
  by move=> kA _; rewrite -setDE; exact: enough.
have [h|h] := middle rd w alike (fun k _ _ => erefl) deg mM; [left | right] => k kA;
  by apply: h; rewrite ?inE.
Qed.

(* "In total degree" after thm:two-faced: 2F + floor((n - F)/2) neighbours are enough if at most F robots are malicious. *)
Lemma two_faced_degree (N : {set V}) : (#|A| <= F)%N -> (F <= #|V|)%N ->
  (2 * F + (#|V| - F)./2 <= #|N|)%N -> (F + #|~: A|./2 <= #|N :\: A|)%N.
Proof.
move=> few Fn deg; have nA : #|~: A| = (#|V| - #|A|)%N by rewrite -(cardsC A) addKn.
have lost : (#|N :&: A| <= #|A|)%N by apply/subset_leq_card/subsetIr.
have parts := cardsID A N; lia.
Qed.

(* Rounds p = 0, 1, 2, ... with a graph and lies of their own each. *)
Section Rounds.
Variables (N : nat -> V -> {set V}) (view : nat -> V -> V -> R) (y : nat -> V -> R).
Hypothesis rounds : forall p, round (N p) (view p) (y p) (y p.+1).

Theorem interval_for_ever m M : within (y 0%N) m M -> forall p, within (y p) m M.
Proof. by move=> w; elim=> // p IH; exact: (interval (rounds p) IH). Qed.

Lemma decays D : (forall p E, spread (y p) E -> spread (y p.+1) ((1 - b / 2%:R) * E)) ->
  spread (y 0%N) D -> forall p, spread (y p) ((1 - b / 2%:R) ^+ p * D).
Proof.
move=> step sp; elim=> [|p IH]; first by rewrite expr0 mul1r.
by rewrite exprS -mulrA; exact: step.
Qed.

Theorem geometric_decay D : (forall p, one_voice (N p) (view p)) ->
  (forall p i, i \notin A -> (F + #|V|./2 <= #|N p i|)%N) ->
  spread (y 0%N) D -> forall p, spread (y p) ((1 - b / 2%:R) ^+ p * D).
Proof.
by move=> voice deg; apply: decays => p E; exact: (contraction (rounds p) (voice p) (deg p)).
Qed.

Theorem geometric_decay_two_faced D :
  (forall p i, i \notin A -> (F + #|~: A|./2 <= #|N p i :\: A|)%N) ->
  spread (y 0%N) D -> forall p, spread (y p) ((1 - b / 2%:R) ^+ p * D).
Proof. by move=> deg; apply: decays => p E; exact: (two_faced (rounds p) (deg p)). Qed.
End Rounds.
End Agreement.
