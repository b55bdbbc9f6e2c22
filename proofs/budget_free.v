(* Sums without the F largest terms (docs/theory/budget.md: thm:free, eq:known). The theorem itself is in budget_free_team.v.

   In words. T_k is the sum of the weights of k without its F largest. It is at most the sum without any other F
   (`trimmed_least`), and it never rises when weights fall or are not seen (`trimmed_mono`). If, for each set A' of F robots that
   contains the malicious ones A, the weights of k to robots outside of A' sum to theta or more, then k has at least theta + F -
   |A| normal neighbours (`normal_many`), which is enough for thm:two-faced (`free_is_enough`). *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect zify.
From Closeranks Require Import vectors weights.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

(* m members of Y, of X first. *)
Lemma choose (V : finType) (X Y : {set V}) m : X \subset Y -> (m <= #|Y|)%N ->
  exists B : {set V}, [/\ B \subset Y, #|B| = m & B \subset X \/ X \subset B].
Proof.
move=> XY mY; pose s := enum X ++ enum (Y :\: X).
have us : uniq s.
  rewrite cat_uniq !enum_uniq andbT /=; apply/hasPn => j; rewrite mem_enum inE => /andP [jX _].
  by change (j \notin enum X); rewrite mem_enum.
have ss : size s = #|Y| by rewrite size_cat -!cardE -(cardsID X Y) (setIidPr XY).
have ms : (m <= size s)%N by rewrite ss.
exists [set j in take m s]; split.
- apply/subsetP => j; rewrite inE => /mem_take; rewrite mem_cat !mem_enum => /orP [/(subsetP XY) // | ].
  by rewrite inE => /andP [].
- by rewrite cardsE -[RHS](size_takel ms); apply/card_uniqP; exact: take_uniq.
- case: (leqP m (size (enum X))) => le; [left | right]; apply/subsetP => j.
    by rewrite inE /s takel_cat // => /mem_take; rewrite mem_enum.
  by move=> jX; rewrite inE /s take_cat ltnNge (ltnW le) /= mem_cat mem_enum jX.
Qed.

(* T_k is the sum of the weights of k without its F largest. *)
Section Trimmed.
Variables (V : finType) (k : V) (F : nat).
Implicit Types (a : V -> R) (B : {set V}).
Definition outside a B := \big[Rplus/0]_(j in ~: (k |: B)) a j.
(* B are F robots with the largest weights. *)
Definition largest a B := [/\ k \notin B, #|B| = F & forall i j, i \in B -> j \notin k |: B -> a j <= a i].

Lemma sum_split a B (C : {set V}) : k \notin B ->
  outside a C = \big[Rplus/0]_(j in ~: (k |: B) :\: C) a j + \big[Rplus/0]_(j in B :\: C) a j.
Proof.
move=> kB; rewrite /outside (bigID (fun j => j \in B)) /= Rplus_comm; congr (_ + _); apply: eq_bigl => j; rewrite !inE negb_or.
  by case: (j == k); case: (j \in B); case: (j \in C).
by case: eqP => [-> | _]; rewrite ?(negPf kB) ?andbF //; case: (j \in B); case: (j \in C).
Qed.

(* Leaving out any other F robots leaves at least as much. *)
Lemma trimmed_least a B (C : {set V}) : largest a B -> k \notin C -> #|C| = F -> outside a B <= outside a C.
Proof.
move=> [kB cardB big] kC cardC; rewrite (sum_split a C kB) (sum_split a B kC).
have -> : ~: (k |: C) :\: B = ~: (k |: B) :\: C.
  by apply/setP => j; rewrite !inE !negb_or; case: (j == k); case: (j \in B); case: (j \in C).
set X := B :\: C; set Y := C :\: B; suff : \big[Rplus/0]_(j in Y) a j <= \big[Rplus/0]_(i in X) a i by lra.
have cards : #|X| = #|Y|.
  by have := cardsID C B; have := cardsID B C; rewrite setIC cardB cardC /X /Y; lia.
have pairs i j : i \in X -> j \in Y -> a j <= a i.
  rewrite !inE => /andP [_ iB] /andP [jB jC]; apply: big => //; rewrite !inE negb_or jB andbT.
  by apply: contraTneq jC => ->.
have [X0 | Xpos] := posnP #|X|.
  have Y0 : #|Y| = 0%N by rewrite -cards.
  by move/eqP: X0; move/eqP: Y0; rewrite !cards_eq0 => /eqP -> /eqP ->; rewrite !big_set0; lra.
have n0 : 0 < INR #|X| by apply: lt_0_INR; apply/ltP.
apply: (Rmult_le_reg_l (INR #|X|)) => //; rewrite -sum_scale {2}cards -sum_const.
by apply: sum_le => j jY; rewrite -sum_const; apply: sum_le => i iX; exact: pairs.
Qed.

Lemma outside_mono a a' B : (forall j, a' j <= a j) -> outside a' B <= outside a B.
Proof. by move=> le; apply: sum_le. Qed.

(* eq:known for a trimmed sum: it never rises when weights fall or are not seen. *)
Lemma trimmed_mono a a' B B' : (forall j, a' j <= a j) -> largest a B -> largest a' B' ->
  outside a' B' <= outside a B.
Proof.
move=> le [kB cardB _] big; apply: Rle_trans (outside_mono B le).
by apply: trimmed_least.
Qed.
End Trimmed.

(* From sums to neighbours, at one moment. *)
Section Count.
Variables (V : finType) (k : V) (A : {set V}) (F th : nat).
Hypothesis kA : k \notin A.
Hypothesis few : (#|A| <= F)%N.
Hypothesis Fn : (F < #|V|)%N.
Hypothesis th0 : (0 < th)%N.
Definition liars_among (A' : {set V}) := [/\ A \subset A', k \notin A' & #|A'| = F].
Variables (a : V -> R) (eps : R).
Hypothesis nonneg : forall j, 0 <= a j.
Hypothesis eps0 : 0 <= eps.
Hypothesis eps_small : (INR th - 1) * eps < 2.
Hypothesis height : forall j, a j <= 1 + eps / 2.
Definition normal_neighbours := [set j | (j \notin A) && (j != k) & (Rlt_dec 0 (a j) : bool)].

Theorem normal_many : (forall A', liars_among A' -> INR th <= outside k a A') ->
  (th + (F - #|A|) <= #|normal_neighbours|)%N.
Proof.
move=> sums; rewrite leqNgt; apply/negP => less; set N := normal_neighbours in less *.
have NY : N \subset ~: (k |: A).
  by apply/subsetP => j; rewrite !inE negb_or => /andP [/andP [-> ->]].
have room : (F - #|A| <= #|~: (k |: A)|)%N.
  by have := cardsC (k |: A); rewrite cardsU1 kA; move: few Fn; lia.
have [B [BY cardB side]] := choose NY room.
have BA : [disjoint A & B].
  rewrite -setI_eq0; apply/eqP/setP => j; rewrite !inE; apply/andP => -[jA jB].
  by have := subsetP BY j jB; rewrite !inE jA orbT.
have among : liars_among (A :|: B).
  split; first exact: subsetUl.
    by rewrite inE negb_or kA; apply/negP => /(subsetP BY); rewrite !inE eqxx.
  by have := leq_card_setU A B; rewrite cardsU; move: BA; rewrite -setI_eq0 => /eqP ->; rewrite cards0 cardB; move: few; lia.
have many := sums _ among.
have : (th <= #|N :\: B|)%N.
  apply: (degree_counts (a := a) (eps := eps)) => //.
  have -> : \big[Rplus/0]_(j in N :\: B) a j = outside k a (A :|: B); last by lra.
  rewrite /outside [RHS](bigID (fun j => j \in N)) /= [X in _ = _ + X]big1 ?Rplus_0_r.
    apply: eq_bigl => j; rewrite !inE; case: (j \in B); rewrite ?orbT ?andbF //= orbF.
    by case: (j == k); case: (j \in A); rewrite ?andbF ?andbT.
  move=> j /andP []; rewrite !inE !negb_or => /andP [jk /andP [jA jB]]; rewrite jA jk /=.
  case: (Rlt_dec 0 (a j)) => // h _; have := nonneg j; lra.
move: side => [BN | NB].
  by have := cardsID B N; rewrite (setIidPr BN) cardB; move: less; lia.
have -> : N :\: B = set0 by apply/eqP; rewrite setD_eq0.
by rewrite cards0; move: th0; lia.
Qed.
End Count.

(* theta + F - a normal neighbours are what thm:two-faced asks for. *)
Lemma free_is_enough n F a : (a <= F)%N -> (F <= n)%N ->
  (F + (n - a)./2 <= F + (n - F)./2 + (F - a))%N.
Proof. lia. Qed.
