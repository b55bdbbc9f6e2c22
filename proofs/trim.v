(* Sort and trim (docs/theory/agreement.md, "W-MSR"; crates/core/src/wmsr.rs).

   In words. `cut` is what the Rust function `update` does, written as a function: sort what was told; of the values below the
   own one drop the F smallest, of those above it the F largest, or all if there are fewer; keep the rest. `update` is the
   mean of the own value and what is kept, with equal weights.

   The theorem `update_is_wmsr` says that this is a step of W-MSR(F) as round.v describes it, with least weight b = 1/n,
   in whatever order the values were told.

   `cut` is polymorphic. Here it is used with numbers of any real field; wmsr_table.v runs the same function on whole numbers and
   writes the tables that the Rust function is held against. Rounding and values that are not finite are not modelled. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Closeranks Require Import round.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.Theory.

Section Model.
Variables (T : Type) (le lt : rel T).

(* How many are dropped below, how many above, and what is kept, in rising order. *)
Definition cut (F : nat) (own : T) (told : seq T) : nat * nat * seq T :=
  let s := sort le told in
  let small := minn (count (fun v => lt v own) s) F in
  let large := minn (count (fun v => lt own v) s) F in
  (small, large, drop small (take (size s - large) s)).
End Model.

(* In a sorted sequence the members of a set that is closed downwards stand first, *)
Lemma filter_first (T : Type) (r : rel T) (p : pred T) (s : seq T) : transitive r ->
  (forall u v, r u v -> p v -> p u) -> sorted r s -> filter p s = take (count p s) s.
Proof.
move=> tr down; elim: s => // h s IH /= path_s.
have IHs := IH (path_sorted path_s); case: ifP => ph; first by rewrite add1n /= IHs.
have none : all (predC p) s.
  by apply: sub_all (order_path_min tr path_s) => v hv; apply: contraFN ph => /(down _ _ hv).
by rewrite add0n; move: none; rewrite all_predC has_count -eqn0Ngt IHs => /eqP ->; rewrite !take0.
Qed.

(* and those of a set that is closed upwards stand last. *)
Lemma filter_last (T : Type) (r : rel T) (q : pred T) (s : seq T) : transitive r ->
  (forall u v, r u v -> q u -> q v) -> sorted r s -> filter q s = drop (size s - count q s) s.
Proof.
move=> tr up; elim: s => // h s IH /= path_s.
have IHs := IH (path_sorted path_s); case: ifP => qh.
  have every : all q s by apply: sub_all (order_path_min tr path_s) => v hv; exact: up hv qh.
  have /eqP -> : count q s == size s by rewrite -all_count.
  by rewrite add1n subnn drop0; congr cons; apply/all_filterP.
by rewrite add0n subSn ?count_size // IHs.
Qed.

Local Open Scope ring_scope.

Section Meets.
Variables (V : finType) (R : realFieldType).

Definition update (F : nat) (own : R) (told : seq R) : R :=
  let kept := (cut <=%R <%R F own told).2 in (own + \sum_(v <- kept) v) / (size kept).+1%:R.

Variables (F : nat) (i : V) (x : V -> R) (N : {set V}).
Hypothesis iN : i \notin N.

Let le := relpre x <=%R.
Let s := sort le (enum N).
Let p := fun j => x j < x i.
Let q := fun j => x i < x j.
Let small := minn (count p s) F.
Let large := minn (count q s) F.
Let B := take small s.                            (* dropped below *)
Let C := drop small (take (size s - large) s).    (* kept *)
Let U := drop (size s - large) s.                 (* dropped above *)
Let K := [set j in C].

Lemma le_trans' : transitive le. Proof. by move=> u v w; exact: le_trans. Qed.
Lemma le_total' : total le. Proof. by move=> u v; exact: le_total. Qed.
Lemma s_sorted : sorted le s. Proof. exact: sort_sorted le_total' _. Qed.
Lemma s_mem j : (j \in s) = (j \in N). Proof. by rewrite mem_sort mem_enum. Qed.
Lemma s_uniq : uniq s. Proof. by rewrite sort_uniq enum_uniq. Qed.

Lemma counts_fit : (count p s + count q s <= size s)%N.
Proof.
rewrite -(count_predC p s) leq_add2l; apply: sub_count => j; rewrite /q /p /= => lt.
by rewrite -leNgt ltW.
Qed.

Lemma parts : s = B ++ C ++ U.
Proof.
have fit : (small <= size s - large)%N.
  have := counts_fit; rewrite /small /large => fit.
  by rewrite leq_subRL; [apply: leq_trans fit; rewrite addnC leq_add ?geq_minl |
    apply: leq_trans fit; rewrite (leq_trans (geq_minl _ _)) ?leq_addl].
by rewrite /B /C /U catA -(take_take fit s) cat_take_drop cat_take_drop.
Qed.

Lemma uniq_parts : uniq (B ++ C ++ U). Proof. by rewrite -parts s_uniq. Qed.

Lemma B_below j : j \in B -> x j < x i.
Proof.
move=> jB; have : j \in filter p s.
  rewrite (filter_first le_trans' _ s_sorted); last by move=> u v; exact: le_lt_trans.
  by move: jB; rewrite /B -(take_take (geq_minl (count p s) F) s) => /mem_take.
by rewrite mem_filter => /andP [].
Qed.

Lemma U_above j : j \in U -> x i < x j.
Proof.
move=> jU; have : j \in filter q s.
  rewrite (filter_last le_trans' _ s_sorted); last by move=> u v uv iu; exact: lt_le_trans iu uv.
  have le1 : (size s - count q s <= size s - large)%N by rewrite leq_sub2l ?geq_minl.
  by move: jU; rewrite /U -(subnK le1) -drop_drop => /mem_drop.
by rewrite mem_filter => /andP [].
Qed.

Lemma mem_parts j : j \in N -> [|| j \in B, j \in C | j \in U].
Proof. by rewrite -s_mem parts !mem_cat. Qed.

Lemma not_dropped_below j : j \in C -> j \notin B.
Proof.
have := uniq_parts; rewrite cat_uniq => /and3P [_ /hasPn no _] jC.
by apply: no; rewrite mem_cat jC.
Qed.

Lemma not_dropped_above j : j \in C -> j \notin U.
Proof.
have := uniq_parts; rewrite cat_uniq => /and3P [_ _]; rewrite cat_uniq => /and3P [_ /hasPn no _] jC.
by apply/negP => /no /negP; apply.
Qed.

Lemma below_is_B : below i x N K = [set j in B].
Proof.
apply/setP => j; rewrite !inE; apply/andP/idP => [[/andP [jC jN] lt] | jB].
  have := mem_parts jN; rewrite (negbTE jC) /= => /orP [] // /U_above.
  by rewrite ltNge (ltW lt).
rewrite (B_below jB) -s_mem parts !mem_cat jB; split=> //; rewrite andbT.
by apply: contraL jB; exact: not_dropped_below.
Qed.

Lemma above_is_U : above i x N K = [set j in U].
Proof.
apply/setP => j; rewrite !inE; apply/andP/idP => [[/andP [jC jN] lt] | jU].
  have := mem_parts jN; rewrite (negbTE jC) /= => /orP [] // /B_below.
  by rewrite ltNge (ltW lt).
rewrite (U_above jU) -s_mem parts !mem_cat jU !orbT; split=> //; rewrite andbT.
by apply: contraL jU; exact: not_dropped_above.
Qed.

Lemma size_B : size B = small.
Proof. by rewrite size_takel // (leq_trans (geq_minl _ _)) ?count_size. Qed.

Lemma size_U : size U = large.
Proof. by rewrite size_drop subKn // (leq_trans (geq_minl _ _)) ?count_size. Qed.

Lemma card_B : #|[set j in B]| = small.
Proof.
have := uniq_parts; rewrite cat_uniq => /and3P [uB _ _].
by rewrite cardsE -size_B; exact/card_uniqP.
Qed.

Lemma card_U : #|[set j in U]| = large.
Proof.
have := uniq_parts; rewrite catA cat_uniq => /and3P [_ _ uU].
by rewrite cardsE -size_U; exact/card_uniqP.
Qed.

Lemma apart : pairwise le (B ++ C ++ U).
Proof. by rewrite -parts -sorted_pairwise ?s_sorted //; exact: le_trans'. Qed.

Theorem cut_trims : trims F i x N K.
Proof.
split.
- by apply/subsetP => j; rewrite inE -s_mem parts !mem_cat => ->; rewrite orbT.
- move=> j jN tie; rewrite inE; have /or3P [/B_below | // | /U_above] := mem_parts jN;
    by rewrite tie ltxx.
- by rewrite below_is_B card_B geq_minr.
- by rewrite above_is_U card_U geq_minr.
- move=> k; rewrite inE => kC lt; rewrite below_is_B card_B; split.
    apply/minn_idPr; rewrite leqNgt; apply/negP => few.
    have E : small = count p s by apply/minn_idPl; exact: ltnW.
    have kB : k \in B.
      rewrite /B E -(filter_first le_trans' _ s_sorted); last by move=> u v; exact: le_lt_trans.
      by rewrite mem_filter /p lt parts !mem_cat kC orbT.
    by have := not_dropped_below kC; rewrite kB.
  move=> j; rewrite inE => jB; have := apart; rewrite pairwise_cat => /and3P [/allrelP all_le _ _].
  by apply: all_le => //; rewrite mem_cat kC.
- move=> k; rewrite inE => kC lt; rewrite above_is_U card_U; split.
    apply/minn_idPr; rewrite leqNgt; apply/negP => few.
    have E : large = count q s by apply/minn_idPl; exact: ltnW.
    have kU : k \in U.
      rewrite /U E -(filter_last le_trans' _ s_sorted); last by move=> u v uv iu; exact: lt_le_trans iu uv.
      by rewrite mem_filter /q lt parts !mem_cat kC orbT.
    by have := not_dropped_above kC; rewrite kU.
  move=> j; rewrite inE => jU; have := apart; rewrite catA pairwise_cat => /and3P [/allrelP all_le _ _].
  by apply: all_le => //; rewrite mem_cat kC orbT.
Qed.

Lemma cut_of (told : seq R) : perm_eq told [seq x j | j <- enum N] ->
  (cut <=%R <%R F (x i) told).2 = [seq x j | j <- C].
Proof.
move=> perm; have -> : cut <=%R <%R F (x i) told = cut <=%R <%R F (x i) [seq x j | j <- enum N].
  rewrite /cut; have -> // : sort <=%R told = sort <=%R [seq x j | j <- enum N].
  by apply/perm_sortP => //; [exact: le_total | exact: le_trans | exact: le_anti].
by rewrite /cut sort_map !count_map size_map -map_take -map_drop.
Qed.

Lemma uniq_C : uniq C.
Proof. by have := uniq_parts; rewrite cat_uniq => /and3P [_ _]; rewrite cat_uniq => /and3P []. Qed.

Lemma iK : i \notin K.
Proof. by apply: contra iN; exact: (subsetP (kept_heard cut_trims)). Qed.

Lemma card_kept : #|i |: K| = (size C).+1.
Proof. by rewrite cardsU1 iK add1n cardsE; congr _.+1; exact/card_uniqP/uniq_C. Qed.

Theorem update_is_wmsr (told : seq R) : perm_eq told [seq x j | j <- enum N] ->
  wmsr_step F (#|V|%:R^-1) i x N (update F (x i) told).
Proof.
move=> perm; exists K, (fun _ => (size C).+1%:R^-1); split; first exact: cut_trims.
have kept := cut_of perm; split.
- move=> j _; rewrite lef_pinv ?qualifE ?ltr0n // ?ler_nat -?card_kept ?max_card //.
  by apply/card_gt0P; exists i.
- by rewrite sumr_const card_kept -[_ *+ _]mulr_natr mulVf // pnatr_eq0.
- rewrite /update kept size_map big_map -mulr_sumr mulrC; congr (_ * _).
  rewrite big_setU1 ?iK //=; congr (_ + _); rewrite big_uniq ?uniq_C //.
  by apply: eq_bigl => j; rewrite inE.
Qed.
End Meets.
