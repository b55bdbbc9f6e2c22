(* A checked checker of proofs by eigenvalues (docs/theory/robustness.md, sec:spectrum).

   In words. Evidence is a network whose links have no direction, whole numbers p, q, Q and two triangles of whole numbers. The first
   triangle proves that q/p is at most the second eigenvalue of the Laplacian, the other that Q/p is at least the largest one
   (spectrum_check.v). For each number x of exempt members `least` is the least size that `size_bound` leaves to a set with a content
   member, with t = 0, 1/16, .., 1. If two such sets with fewer than s exempt members have more than n nodes together, the network is
   (r,s)-robust: `eigen_sound`. All numbers are whole, of any size. *)

From Coq Require Import Reals Lra Psatz ZArith.
From mathcomp Require Import all_ssreflect zify.
From Closeranks Require Import vectors robust evidence spectrum spectrum_check.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Fixpoint dotz (a b : seq Z) : Z := match a, b with x :: s, y :: t => (x * y + dotz s t)%Z | _, _ => 0%Z end.
Definition sumz (f : nat -> Z) n := foldr (fun u acc => (f u + acc)%Z) 0%Z (iota 0 n).
Definition both_ways (g : network) := all (fun v => all (fun u => member v (heard g u)) (heard g v)) (iota 0 (size g)).
Definition lapz (g : network) u v : Z :=
  if Nat.eqb u v then Z.of_nat (size (heard g u)) else if member v (heard g u) then (-1)%Z else 0%Z.
Definition entry g p q k s (T : seq (seq Z)) u v : Z :=
  (s * s * (p * lapz g u v - (if Nat.eqb u v then q else 0) + k) - dotz (nth [::] T u) (nth [::] T v))%Z.
Definition psd_check g p q k s T := [&& Z.ltb 0 s, all (fun row => Nat.leb (size row) (size g)) T &
  all (fun u => Z.leb (sumz (fun v => if Nat.eqb v u then 0%Z else Z.abs (entry g p q k s T u v)) (size g)) (entry g p q k s T u u))
    (iota 0 (size g))].

(* 256 p times both sides of `size_bound`, with t/16 for t. *)
Definition leaves n p Q dm x : Z := Z.min (p * n * x * dm) (Q * x * (n - x)).
Definition allows n p q Q dm r a x t : bool :=
  Z.leb (q * (256 * a * (n - a) - 32 * t * a * x + t * t * x * (n - x)))
    (p * n * (256 * (r - 1) * a + Z.max 0 (256 - 32 * t) * a * x) + t * t * leaves n p Q dm x).
Definition possible n p q Q dm r a x := all (fun t =>
  allows (Z.of_nat n) p q Q (Z.of_nat dm) (Z.of_nat r) (Z.of_nat a) (Z.of_nat x) (Z.of_nat t)) (iota 0 17).
Definition least n p q Q dm r x := (find (fun a => possible n p q Q dm r a x) (iota 1 (n - x))).+1 + x.
Definition degree_most (g : network) := foldr (fun h m => Nat.max (size h) m) 0 g.
Definition eigen_check g r s p q Q k scale T U :=
  [&& network_ok g, both_ways g, Nat.ltb 0 r, Z.ltb 0 p, psd_check g p q k scale T, psd_check g (- p)%Z (- Q)%Z 0%Z scale U &
   let m := map (least (size g) p q Q (degree_most g) r) (iota 0 s) in
   all (fun x1 => all (fun x2 => Nat.leb s (x1 + x2) || Nat.ltb (size g) (nth 0 m x1 + nth 0 m x2)) (iota 0 s)) (iota 0 s)].

Local Open Scope R_scope.

Lemma dotzE n a b : (size a <= n)%N ->
  IZR (dotz a b) = \big[Rplus/0]_(l < n) (IZR (nth 0%Z a l) * IZR (nth 0%Z b l)).
Proof.
elim: n a b => [|n IH] [|x s] b //= le; first by rewrite big_ord0.
  by rewrite big1 // => l _; rewrite nth_nil Rmult_0_l.
case: b => [|y t]; first by rewrite big1 // => l _; rewrite nth_nil Rmult_0_r.
by rewrite big_ord_recl /= plus_IZR mult_IZR (IH s t).
Qed.

Lemma sumzE f n : IZR (sumz f n) = \big[Rplus/0]_(u < n) IZR (f u).
Proof.
rewrite /sumz -(big_mkord xpredT (fun u => IZR (f u))) /index_iota subn0.
by elim: (iota 0 n) => [|u t IH] /=; rewrite ?big_nil // big_cons plus_IZR IH.
Qed.

Section Network.
Variable g : network.
Hypothesis ok : network_ok g.
Hypothesis both : both_ways g.
Let n := size g.
Definition E (u v : 'I_n) : bool := (v : nat) \in heard g u.

Lemma E_sym : symmetric E.
Proof.
have half (u v : 'I_n) : E u v -> E v u.
  move=> uv; have := allP both u; rewrite mem_iota /= => /(_ (ltn_ord u)) /allP /(_ _ uv).
  by rewrite memberE.
by move=> u v; apply/idP/idP; exact: half.
Qed.

Lemma E_loop (u : 'I_n) : E u u = false.
Proof. by have [_ _ no] := evidence.row ok u; exact/negbTE. Qed.

Lemma sum_edges (P : pred 'I_n) (u : 'I_n) : \big[Rplus/0]_(v | P v) edge E u v = INR #|[set v in N u | P v]|.
Proof.
rewrite /edge (bigID (fun v => E u v)) /= [X in _ + X]big1 => [|v /andP [_ /negbTE ->]] //.
rewrite Rplus_0_r (eq_bigr (fun=> 1)) => [|v /andP [_ ->]] //; rewrite sum_const Rmult_1_r; congr INR.
by apply: eq_card => v; rewrite !inE; exact: andbC.
Qed.

Lemma degreeE (u : 'I_n) : degree E u = INR (size (heard g u)).
Proof.
rewrite /degree sum_edges; congr INR.
have -> : [set v in N u | true] = [set v in N u | predT (v : nat)] by [].
by rewrite (card_count ok) count_predT.
Qed.

Lemma lapzE (u v : 'I_n) : IZR (lapz g u v) = INR (u == v) * degree E u - edge E u v.
Proof.
rewrite /lapz eqbE memberE -/(E u v) /edge -val_eqE /=; case: eqP => [uv | _].
  by rewrite degreeE -INR_IZR_INZ (_ : v = u) ?E_loop /=; [lra | exact/esym/val_inj].
by case: (E u v) => /=; lra.
Qed.

Lemma psd p q k s T : psd_check g p q k s T -> forall w, 0 <= form (matrix E (IZR p) (IZR q) (IZR k)) w.
Proof.
move=> /and3P [/Z.ltb_lt /IZR_lt s0 sizes rows] w.
pose Tr (u l : 'I_n) := IZR (nth 0%Z (nth [::] T u) l).
pose Er (u v : 'I_n) := IZR (entry g p q k s T u v).
have short (u : 'I_n) : (size (nth [::] T u) <= n)%N.
  case: (ltnP u (size T)) => [lt | le]; last by rewrite nth_default.
  by rewrite -lebE; exact: (all_nthP [::] sizes).
have entryE (u v : 'I_n) : Er u v = IZR s * IZR s * matrix E (IZR p) (IZR q) (IZR k) u v - \big[Rplus/0]_l (Tr u l * Tr v l).
  rewrite /Er /entry minus_IZR (dotzE _ (short u)) !mult_IZR plus_IZR minus_IZR mult_IZR lapzE /matrix.
  have -> : IZR (if Nat.eqb u v then q else 0%Z) = IZR q * INR (u == v).
    by rewrite eqbE -val_eqE /=; case: eqP => _ /=; lra.
  by [].
have sq : 0 < IZR s * IZR s by nra.
apply: (Rmult_le_reg_l (IZR s * IZR s)) => //; rewrite Rmult_0_r -form_scale.
have -> : form (fun u v => IZR s * IZR s * matrix E (IZR p) (IZR q) (IZR k) u v) w =
    form Er w + form (fun u v => \big[Rplus/0]_l (Tr u l * Tr v l)) w.
  by rewrite -form_add; apply: form_eq => u v; rewrite entryE; lra.
have := form_square Tr w; have : 0 <= form Er w; last by lra.
have Mr_sym (u v : 'I_n) : matrix E (IZR p) (IZR q) (IZR k) u v = matrix E (IZR p) (IZR q) (IZR k) v u.
  rewrite /matrix /edge (E_sym u v) (eq_sym u v); case: eqP => [-> | _] //=; lra.
apply: form_dominant => [u v | u].
  by rewrite !entryE Mr_sym; congr (_ - _); apply: eq_bigr => l _; rewrite Rmult_comm.
have := allP rows u; rewrite mem_iota /= => /(_ (ltn_ord u)) /Z.leb_le /IZR_le; rewrite sumzE.
apply: Rle_trans; apply: Req_le; rewrite [RHS](bigD1 u) //= eqbE eqxx /= Rplus_0_l.
by apply: eq_bigr => v /negbTE vu; rewrite eqbE val_eqE vu abs_IZR.
Qed.

Lemma degree_mostP (u : 'I_n) : (size (heard g u) <= degree_most g)%N.
Proof.
have in_list (t : network) h : h \in t -> (size h <= degree_most t)%N.
  by elim: t => //= h' t IH; rewrite inE => /orP [/eqP -> | /IH le]; rewrite /degree_most /= -/(degree_most t); lia.
by apply: in_list; exact: mem_nth.
Qed.
End Network.

Lemma IZR_min a b : IZR (Z.min a b) = Rmin (IZR a) (IZR b).
Proof.
case: (Z.le_ge_cases a b) => le; have := IZR_le _ _ le => leR.
  by rewrite Z.min_l // Rmin_left.
by rewrite Z.min_r // Rmin_right.
Qed.

Lemma IZR_max0 y : IZR (Z.max 0 y) = Rmax 0 (IZR y).
Proof.
case: (Z.le_ge_cases 0 y) => le; have := IZR_le _ _ le => leR.
  by rewrite Z.max_r // Rmax_right.
by rewrite Z.max_l // Rmax_left.
Qed.

Section Sizes.
Variables (g : network) (r : nat) (p q Q k scale : Z) (T U : seq (seq Z)).
Hypotheses (ok : network_ok g) (both : both_ways g) (r0 : (0 < r)%N) (p0 : 0 < IZR p).
Hypotheses (low : psd_check g p q k scale T) (high : psd_check g (- p)%Z (- Q)%Z 0%Z scale U).
Let n := size g.
Let dm := degree_most g.

Lemma second w : 2 * (IZR q / IZR p) * spread w <= INR #|'I_n| * laplacian (@E g) w.
Proof.
have := spread_bound (E_sym both) w (psd ok both low); rewrite -/n => h.
apply: (Rmult_le_reg_l (IZR p)) => //; apply: Rle_trans h; apply: Req_le; field; lra.
Qed.

Lemma first w : IZR p * (INR #|'I_n| * laplacian (@E g) w) <= 2 * IZR Q * spread w.
Proof.
have h : 2 * - IZR Q * spread w <= - IZR p * (INR #|'I_n| * laplacian (@E g) w).
  by have := spread_bound (E_sym both) w (psd ok both high); rewrite !opp_IZR.
lra.
Qed.

Variable S : {set 'I_n}.
Hypothesis not_full : reach (@N g) r S != S.
Let D := reach (@N g) r S.
Let A := S :\: D.

Lemma D_in_S : D \subset S.
Proof. by apply/subsetP => v; rewrite inE => /andP []. Qed.

Lemma both_parts : A :|: D = S.
Proof.
by apply/setP => v; rewrite !inE; case: (v \in S) => //=; case: (_ <= _)%N.
Qed.

Lemma parts_apart : [disjoint A & D].
Proof. by rewrite -setI_eq0; apply/eqP/setP => v; rewrite !inE; case: (v \in S); case: (_ <= _)%N. Qed.

Lemma content_few u : u \in A -> sum (v in ~: (A :|: D)) edge (@E g) u v <= INR r - 1.
Proof.
rewrite both_parts sum_edges inE => /andP [uD uS].
have : (#|N u :\: S| < r)%N by move: uD; rewrite inE uS /= -ltnNge.
have -> : [set v in N u | v \in ~: S] = N u :\: S by apply/setP => v; rewrite !inE andbC.
move=> lt; have := le_INR _ _ (leP lt); rewrite S_INR; lra.
Qed.

Definition M := Rmin (IZR p * INR n * INR #|D| * INR dm) (IZR Q * INR #|D| * (INR n - INR #|D|)).

Lemma leaving_few : 0 < INR n -> edges (@E g) D (~: D) <= M / (IZR p * INR n).
Proof.
move=> n0; have pn : 0 < IZR p * INR n by nra.
apply: (Rmult_le_reg_l (IZR p * INR n)) => //.
have -> : IZR p * INR n * (M / (IZR p * INR n)) = M by field; lra.
apply: Rmin_glb.
  have deg (u : 'I_n) : degree (@E g) u <= INR dm.
    by rewrite degreeE //; apply/le_INR/leP; exact: degree_mostP.
  have le := leaving_degrees D deg; apply: Rle_trans (Rmult_le_compat_l _ _ _ (Rlt_le _ _ pn) le) _.
  by apply: Req_le; ring.
have := leaving_bound (E_sym both) D p0 first; rewrite card_ord -/n => le.
by apply: Rle_trans le _; apply: Req_le; ring.
Qed.

Lemma size_least : (least n p q Q dm r #|D| <= #|S|)%N.
Proof.
have cards : (#|A| + #|D| = #|S|)%N.
  by rewrite -both_parts cardsU (_ : A :&: D = set0) ?cards0 ?subn0 //; apply/eqP; rewrite setI_eq0 parts_apart.
have A0 : (0 < #|A|)%N.
  rewrite card_gt0; apply: contraNneq not_full => empty; apply/eqP.
  by have := both_parts; rewrite empty set0U.
have inn : (#|A| + #|D| <= n)%N by rewrite cards -[X in (_ <= X)%N]card_ord max_card.
have n0 : 0 < INR n by apply: (lt_INR 0); lia.
have can : possible n p q Q dm r #|A| #|D|.
  apply/allP => t; rewrite mem_iota => /andP [_ t16].
  have t1 : 0 <= INR t / 16 <= 1.
    have := pos_INR t; have t17 : (t <= 16)%N by lia.
    have := le_INR _ _ (leP t17); have -> : INR 16 = 16 by rewrite INR_IZR_INZ.
    by move=> *; lra.
  pose a := INR #|A|; pose x := INR #|D|; pose m := INR n; pose tt := INR t.
  have H : IZR q / IZR p * (a * (m - a) - 2 * (tt / 16) * a * x + tt / 16 * (tt / 16) * (x * (m - x))) <=
      m * ((INR r - 1) * a + Rmax 0 (1 - 2 * (tt / 16)) * (a * x) + tt / 16 * (tt / 16) * (M / (IZR p * m))).
    have := @size_bound _ (@E g) (E_sym both) A D parts_apart (tt / 16) (IZR q / IZR p) (INR r - 1)
      (M / (IZR p * m)) second content_few (leaving_few n0) t1.
    by rewrite card_ord.
  have goal : IZR q * (256 * a * (m - a) - 32 * tt * a * x + tt * tt * x * (m - x)) <=
      IZR p * m * (256 * (INR r - 1) * a + Rmax 0 (256 - 32 * tt) * a * x) + tt * tt * M.
    move: n0 H; rewrite -/m; move: a x m tt M {t1} => a x m tt M n0 H.
    have pos : 0 <= 256 * IZR p by lra.
    have := Rmult_le_compat_l _ _ _ pos H.
    have -> : Rmax 0 (256 - 32 * tt) = 256 * Rmax 0 (1 - 2 * (tt / 16)).
      by rewrite /Rmax; case: Rle_dec => ?; case: Rle_dec => ?; lra.
    move: (Rmax _ _) => mx {}H; apply: Rle_trans (Rle_trans _ _ _ _ H) _; apply: Req_le; field; lra.
  apply/Z.leb_le/le_IZR; rewrite /leaves !(mult_IZR, plus_IZR, minus_IZR, IZR_min, IZR_max0) -!INR_IZR_INZ.
  exact: goal.
rewrite /least -cards addnC [X in (_ <= X)%N]addnC leq_add2l -(prednK A0) ltnS leqNgt; apply/negP => early.
have := before_find 0%N early; rewrite nth_iota; last by lia.
by rewrite add1n prednK // can.
Qed.
End Sizes.

Theorem eigen_sound g r s p q Q k scale T U : eigen_check g r s p q Q k scale T U -> robust (@N g) r s.
Proof.
move=> /and5P [ok both r0 /Z.ltb_lt /IZR_lt p0 /and3P [low high fit]].
rewrite ltbE in r0; apply: (@two_sets_do_not_fit _ (@N g) r s (least (size g) p q Q (degree_most g) r)).
  by move=> S _ not_full; by apply: (size_least (k := k) (scale := scale) (T := T) (U := U)).
move=> x1 x2 few; rewrite card_ord.
have x1s : (x1 < s)%N by lia.
have x2s : (x2 < s)%N by lia.
have := allP fit x1; rewrite mem_iota x1s => /(_ isT) /allP /(_ x2); rewrite mem_iota x2s => /(_ isT).
rewrite lebE leqNgt few /= ltbE !(nth_map 0%N) ?size_iota // !nth_iota //.
Qed.
