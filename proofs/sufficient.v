(* Robustness is enough for W-MSR (docs/theory/robustness.md: sec:groups).

   In words. A graph is (F+1,F+1)-robust. At most F robots lie in all, and each liar tells everybody who hears it the same value, another one in each
   round if it likes. Honest robots tell the truth and apply W-MSR(F) as round.v describes it, each weight at least b. The graph stays.

   `hull`: honest values stay between the least and the greatest of the start. It needs no robustness.
   `robust_decay`: with h honest robots and n = h, every n rounds leave at most 1 - b^n/2 of what lay between honest values.
   `settle`: from round q n on no two honest values differ by more than (1 - b^n/2)^q times what lay between them at the start, also those of different
   rounds. So for b > 0 all of them go to one limit, which lies between the honest values of the start.

   Together with `no_agreement` of groups.v: (F+1,F+1)-robustness is necessary and enough.

   The argument. Let M and m be the greatest and the least honest value. A robot is high if it tells more than M - e, low if it tells less than
   m + e, with 2 e <= M - m, so that none is both. Liars may be high or low, too; that is why the sets are of what is told. By robustness some honest robot is high and hears
   F + 1 that are not, or low and hears F + 1 that are not: if all of the high reach out, an honest one does, and if F + 1 of both do, at most F of them lie. It comes to at
   most M - b e. Whoever is not high is at most at M - b e too, after the round, because of its own weight. So with b e in place of e one honest robot fewer is high or
   low, and none is more. After n rounds no honest robot is high, or none is low. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Closeranks Require Import round robust groups agreement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.Theory.
Local Open Scope ring_scope.

Section Sufficient.
Variables (V : finType) (R : realFieldType) (F : nat) (b : R) (N : V -> {set V}) (D : {set V}).
Hypothesis b0 : 0 <= b.
Hypothesis few : (#|D| <= F)%N.
Variables (y : nat -> V -> R) (view : nat -> V -> V -> R) (told : nat -> V -> R).
Hypothesis runs : run F b N D y view.
Hypothesis voice : forall p i j, i \notin D -> j \in N i -> j \in D -> view p i j = told p j.

(* What each robot tells. *)
Definition says p j := if j \in D then told p j else y p j.

Lemma heard p i j : i \notin D -> j \in N i -> view p i j = says p j.
Proof. by move=> iD jN; rewrite /says; have [jD | jD] := boolP (j \in D); [exact: voice | have [_ -> //] := runs p iD]. Qed.

Lemma few_too_high p m M i : within D (y p) m M -> i \notin D -> (#|over (view p i) (N i) M| <= F)%N.
Proof.
move=> w iD; apply: leq_trans few; apply/subset_leq_card/subsetP => j; rewrite inE => /andP [jN].
rewrite heard // /says; have [// | jD] := boolP (j \in D); by have /andP [_ le] := w j jD; rewrite ltNge le.
Qed.

Lemma few_too_low p m M i : within D (y p) m M -> i \notin D -> (#|under (view p i) (N i) m| <= F)%N.
Proof.
move=> w iD; apply: leq_trans few; apply/subset_leq_card/subsetP => j; rewrite inE => /andP [jN].
rewrite heard // /says; have [// | jD] := boolP (j \in D); by have /andP [le _] := w j jD; rewrite ltNge le.
Qed.

Lemma hull_round p m M : within D (y p) m M -> within D (y p.+1) m M.
Proof.
move=> w i iD; have [own _ step] := runs p iD; have /andP [lo hi] := w i iD; apply/andP; split.
  by apply: (stays_above b0 step); rewrite ?own ?(few_too_low w).
by apply: (stays_below b0 step); rewrite ?own ?(few_too_high w).
Qed.

Theorem hull p q m M : within D (y p) m M -> within D (y (p + q)%N) m M.
Proof. by move=> w; elim: q => [|q IH]; rewrite ?addn0 // addnS; exact: hull_round. Qed.

Definition high p M e := [set i in ~: D | M - e < y p i].
Definition low p m e := [set i in ~: D | y p i < m + e].

Lemma comes_down p m M e i : within D (y p) m M -> 0 <= e -> i \notin D ->
  y p i <= M - e \/ (F < #|upto (view p i) (N i) (M - e)|)%N -> y p.+1 i <= M - b * e.
Proof.
move=> w e0 iD many; have [own _ step] := runs p iD; have /andP [_ hi] := w i iD.
have := @pulled_down _ _ F b i (view p i) (N i) (y p.+1 i) M (M - e) b0 step; rewrite own subKr; apply=> //.
  exact: (few_too_high w iD).
by rewrite ler_subl_addr ler_addl.
Qed.

Lemma comes_up p m M e i : within D (y p) m M -> 0 <= e -> i \notin D ->
  m + e <= y p i \/ (F < #|from (view p i) (N i) (m + e)|)%N -> m + b * e <= y p.+1 i.
Proof.
move=> w e0 iD many; have [own _ step] := runs p iD; have /andP [lo _] := w i iD.
have := @pulled_up _ _ F b i (view p i) (N i) (y p.+1 i) m (m + e) b0 step; rewrite own [m + e - m]addrC addKr; apply=> //.
  exact: (few_too_low w iD).
by rewrite ler_addl.
Qed.

Lemma high_falls p m M e : within D (y p) m M -> 0 <= e -> high p.+1 M (b * e) \subset high p M e.
Proof.
move=> w e0; apply/subsetP => i; rewrite !inE => /andP [iD gt]; rewrite iD /= ltNge.
by apply/negP => le; have := comes_down w e0 iD (or_introl le); rewrite leNgt gt.
Qed.

Lemma low_falls p m M e : within D (y p) m M -> 0 <= e -> low p.+1 m (b * e) \subset low p m e.
Proof.
move=> w e0; apply/subsetP => i; rewrite !inE => /andP [iD lt]; rewrite iD /= ltNge.
by apply/negP => le; have := comes_up w e0 iD (or_introl le); rewrite leNgt lt.
Qed.

Hypothesis robust_enough : robust N F.+1 F.+1.

Lemma one_fewer p m M e : within D (y p) m M -> 0 <= e -> e + e <= M - m -> high p M e != set0 -> low p m e != set0 ->
  (#|high p.+1 M (b * e)| + #|low p.+1 m (b * e)| < #|high p M e| + #|low p m e|)%N.
Proof.
move=> w e0 ee h0 l0; have hs := high_falls w e0; have ls := low_falls w e0.
pose S1 := [set j | M - e < says p j]; pose S2 := [set j | says p j < m + e].
have in1 i : i \in high p M e -> i \in S1 :\: D by rewrite !inE /says => /andP [iD gt]; rewrite iD (negbTE iD).
have in2 i : i \in low p m e -> i \in S2 :\: D by rewrite !inE /says => /andP [iD lt]; rewrite iD (negbTE iD).
have dis : [disjoint S1 & S2].
  apply/pred0P => j /=; rewrite !inE; apply/negP => /andP [gt lt]; have := lt_trans gt lt.
  by rewrite ltr_subl_addr -addrA -ltr_subl_addl ltNge ee.
have n1 : S1 != set0 by have /set0Pn [i /in1] := h0; rewrite inE => /andP [_ iS]; apply/set0Pn; exists i.
have n2 : S2 != set0 by have /set0Pn [i /in2] := l0; rewrite inE => /andP [_ iS]; apply/set0Pn; exists i.
have out1 i : i \notin D -> i \in reach N F.+1 S1 -> i \in high p M e /\ i \notin high p.+1 M (b * e).
  move=> iD; rewrite inE => /andP [iS many]; have gt : M - e < y p i by move: iS; rewrite inE /says (negbTE iD).
  split; first by rewrite !inE iD.
  rewrite !inE iD /= -leNgt; apply: (comes_down w e0 iD); right.
  apply: leq_trans many _; apply/subset_leq_card/subsetP => j; rewrite !inE -leNgt => /andP [le jN].
  by rewrite jN heard.
have out2 i : i \notin D -> i \in reach N F.+1 S2 -> i \in low p m e /\ i \notin low p.+1 m (b * e).
  move=> iD; rewrite inE => /andP [iS many]; have lt : y p i < m + e by move: iS; rewrite inE /says (negbTE iD).
  split; first by rewrite !inE iD.
  rewrite !inE iD /= -leNgt; apply: (comes_up w e0 iD); right.
  apply: leq_trans many _; apply/subset_leq_card/subsetP => j; rewrite !inE -leNgt => /andP [le jN].
  by rewrite jN heard.
have less1 i : i \notin D -> i \in reach N F.+1 S1 -> (#|high p.+1 M (b * e)| < #|high p M e|)%N.
  move=> iD /(out1 i iD) [inn out]; apply: proper_card; apply/properP; split=> //; by exists i.
have less2 i : i \notin D -> i \in reach N F.+1 S2 -> (#|low p.+1 m (b * e)| < #|low p m e|)%N.
  move=> iD /(out2 i iD) [inn out]; apply: proper_card; apply/properP; split=> //; by exists i.
have hc := subset_leq_card hs; have lc := subset_leq_card ls.
case: (robust_enough n1 n2 dis) => [all | all | many].
- have /set0Pn [i /in1] := h0; rewrite inE => /andP [iD iS]; by rewrite -all in iS; rewrite -addSn leq_add ?(less1 i iD iS).
- have /set0Pn [i /in2] := l0; rewrite inE => /andP [iD iS]; by rewrite -all in iS; rewrite -addnS leq_add ?(less2 i iD iS).
have [i] : exists i, i \in (reach N F.+1 S1 :|: reach N F.+1 S2) :\: D.
  apply/set0Pn; rewrite setD_eq0; apply/negP => /subset_leq_card le.
  have cu : #|reach N F.+1 S1 :|: reach N F.+1 S2| = (#|reach N F.+1 S1| + #|reach N F.+1 S2|)%N.
    rewrite -cardsUI (_ : _ :&: _ = set0) ?cards0 ?addn0 //; apply/setP => j; rewrite !inE.
    by have := pred0P dis j; rewrite /= !inE => no; apply/negP => /andP [/andP [one _] /andP [two _]]; rewrite one two in no.
  by have := leq_trans many (leq_trans (eq_leq (esym cu)) (leq_trans le few)); rewrite ltnn.
rewrite inE in_setU => /andP [iD /orP [one | two]].
  by rewrite -addSn leq_add ?(less1 i iD one).
by rewrite -addnS leq_add ?(less2 i iD two).
Qed.

Lemma weight_le1 i : i \notin D -> b <= 1.
Proof. by move=> iD; have [_ _ step] := @runs 0%N i iD; exact: (least_weight_le1 b0 step). Qed.

Let n := #|~: D|.

Lemma after p m M : within D (y p) m M -> b <= 1 -> m <= M -> forall k, let e := b ^+ k * ((M - m) / 2%:R) in
  [\/ high (p + k)%N M e = set0, low (p + k)%N m e = set0 | (#|high (p + k)%N M e| + #|low (p + k)%N m e| + k <= n)%N].
Proof.
move=> w b1 mM; have half0 : 0 <= (M - m) / 2%:R by rewrite divr_ge0 ?subr_ge0 ?ler0n.
have e0 k : 0 <= b ^+ k * ((M - m) / 2%:R) by rewrite mulr_ge0 // exprn_ge0.
have ee k : b ^+ k * ((M - m) / 2%:R) + b ^+ k * ((M - m) / 2%:R) <= M - m.
  by rewrite -mulrDr -splitr ler_pimull ?subr_ge0 // exprn_ile1.
elim=> [|k IH] e.
  constructor 3; rewrite addn0 addn0 /e expr0 mul1r /n.
  rewrite -cardsUI (_ : _ :&: _ = set0) ?cards0 ?addn0.
    by apply/subset_leq_card/subsetP => i; rewrite !inE => /orP [] /andP [].
  apply/setP => i; rewrite !inE; apply/negP => /andP [/andP [_ gt] /andP [_ lt]]; have := lt_trans gt lt.
  by rewrite ltr_subl_addr -addrA -splitr addrC subrK ltxx.
have wk : within D (y (p + k)%N) m M by exact: hull.
have hs := high_falls wk (e0 k); have ls := low_falls wk (e0 k).
have -> : e = b * (b ^+ k * ((M - m) / 2%:R)) by rewrite /e exprS -mulrA.
rewrite addnS; case: (eqVneq (high (p + k)%N M (b ^+ k * ((M - m) / 2%:R))) set0) => [z | h0].
  by constructor 1; apply/eqP; rewrite -subset0 -z.
case: (eqVneq (low (p + k)%N m (b ^+ k * ((M - m) / 2%:R))) set0) => [z | l0].
  by constructor 2; apply/eqP; rewrite -subset0 -z.
constructor 3; have := one_fewer wk (e0 k) (ee k) h0 l0.
case: IH => [z | z | le]; [by rewrite z eqxx in h0 | by rewrite z eqxx in l0 |].
by move=> less; apply: leq_trans le; rewrite addnS -addSn leq_add2r.
Qed.

Lemma many_rounds p E : spread D (y p) E -> spread D (y (p + n)%N) ((1 - b ^+ n / 2%:R) * E).
Proof.
move=> sp i j iD jD; have b1 := weight_le1 iD.
have [m [M [w [[l lD El] [u uD Eu]]]]] := bounds (y p) iD.
have mM : m <= M by have /andP [h1 h2] := w i iD; exact: le_trans h2.
have bn1 : b ^+ n / 2%:R <= 1 by rewrite ler_pdivr_mulr ?ltr0n // mul1r (le_trans (exprn_ile1 _ b0 b1)) // ler1n.
have small : (1 - b ^+ n / 2%:R) * (M - m) <= (1 - b ^+ n / 2%:R) * E.
  by apply: ler_wpmul2l; [rewrite subr_ge0 | rewrite -Eu -El; exact: sp].
apply: le_trans small; have key : (1 - b ^+ n / 2%:R) * (M - m) = M - m - b ^+ n * ((M - m) / 2%:R) by rewrite mulrBl mul1r mulrAC mulrA.
rewrite key; set e := b ^+ n * _; have wn : within D (y (p + n)%N) m M by exact: hull.
have /andP [loi hii] := wn i iD; have /andP [loj hij] := wn j jD.
have none (S : {set V}) : (#|S| <= 0)%N -> S = set0 by rewrite leqn0 cards_eq0 => /eqP.
have [hz | lz] : high (p + n)%N M e = set0 \/ low (p + n)%N m e = set0.
  case: (after w b1 mM n) => [z | z | le]; [by left | by right | left; apply: none].
  by move: le; rewrite -[X in (_ <= X)%N]add0n leq_add2r leqn0 addn_eq0 leqn0 => /andP [].
- have : i \notin high (p + n)%N M e by rewrite hz inE.
  rewrite !inE iD /= -leNgt => le; have := ler_sub le loj; move/le_trans; apply.
  by rewrite addrAC.
- have : j \notin low (p + n)%N m e by rewrite lz inE.
  rewrite !inE jD /= -leNgt => le; have := ler_sub hii le; move/le_trans; apply.
  by rewrite opprD addrA.
Qed.

Theorem robust_decay E : spread D (y 0%N) E -> forall q, spread D (y (q * n)%N) ((1 - b ^+ n / 2%:R) ^+ q * E).
Proof.
move=> sp; elim=> [|q IH]; first by rewrite mul0n expr0 mul1r.
by rewrite mulSn addnC exprS -mulrA; exact: many_rounds.
Qed.

Theorem settle E : spread D (y 0%N) E -> forall q p p' i j, (q * n <= p)%N -> (q * n <= p')%N -> i \notin D -> j \notin D ->
  `|y p i - y p' j| <= (1 - b ^+ n / 2%:R) ^+ q * E.
Proof.
move=> sp q p p' i j qp qp' iD jD; have [m [M [w [[l lD El] [u uD Eu]]]]] := bounds (y (q * n)%N) iD.
have gap := robust_decay sp q uD lD; rewrite Eu El in gap; apply: le_trans gap.
have /andP [a1 a2] := hull (p - q * n)%N w iD; have /andP [c1 c2] := hull (p' - q * n)%N w jD.
rewrite !subnKC // in a1 a2 c1 c2; rewrite ler_norml; apply/andP; split; last by rewrite ler_sub.
by rewrite opprB ler_sub.
Qed.
End Sufficient.
