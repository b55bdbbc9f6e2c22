(* The controller budget with malicious robots that move as they like: a whole team from its rows (docs/theory/budget.md, thm:free).

   In words. Weights of links, T_k = the sum of those of k without its F largest, theta > 0. Normal robots move by (near) and
   (far) with h = T - theta, and count on no more than they see. At the start T_k >= theta for every normal k, and normal robots are
   Dd apart. Then, wherever the a <= F malicious robots A are at any time, at every tick and at every moment between two ticks,
   every normal robot has at least theta + F - a normal neighbours in range, and no two normal robots are closer than Dd.

   Nothing is asked of malicious robots: their positions are any at all. Assumed of the weight: between 0 and 1 + eps/2, 0 out
   of range, and the slope bound of eq:slope-bound for moves of at most rho. Assumed of the settings: R - 2 rho >= Dd and
   eps < 2/(theta - 1).

   The proof follows, for each set A' of F robots that contains A, the sum of the weights of k to robots outside of A'. It is at
   least T_k, and loses no more than its share in a tick, which is far_tick of budget.v with the robots outside of A' as those
   that count. So it stays at theta or more for each A'. *)

From Coq Require Import Reals Lra Psatz FunctionalExtensionality.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors budget loss budget_run budget_free.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Team.
Variable gamma : R.
Hypothesis gamma01 : 0 < gamma <= 1.
Variables (V : finType) (d : nat) (A : {set V}) (F th : nat) (radius rho : R).
Hypothesis few : (#|A| <= F)%N.
Hypothesis Fn : (F < #|V|)%N.
Hypothesis th0 : (0 < th)%N.
Let R2 := radius * radius.

Variables (weight : vec d -> R) (eps : R).
Hypothesis weight_nonneg : forall r, 0 <= weight r.
Hypothesis height : forall r, weight r <= 1 + eps / 2.
Hypothesis out_of_range : forall r, R2 < sq r -> weight r = 0.
Hypothesis eps0 : 0 <= eps.
Hypothesis eps_small : (INR th - 1) * eps < 2.

(* Positions at ticks 0, 1, 2, ...; moves, slope bounds, what i counts on for k, and its share. *)
Variables (x v : nat -> V -> vec d) (L b share : nat -> V -> V -> R).
Hypothesis moves : forall p i, i \notin A -> x p.+1 i = plus (x p i) (v p i).
Hypothesis longest : forall p i, i \notin A -> sq (v p i) <= rho * rho.
Definition offset p i j : vec d := minus (x p i) (x p j).
Definition in_range p i j : bool := Rle_dec (sq (offset p i j)) R2.
Definition a p k j := weight (offset p k j).

Hypothesis L_nonneg : forall p i j, 0 <= L p i j.
Hypothesis L_sym : forall p i j, L p i j = L p j i.
(* eq:slope-bound *)
Hypothesis falls : forall p i j w, i \notin A -> j \notin A -> in_range p i j -> sq w <= 4 * (rho * rho) ->
  weight (plus (offset p i j) w) >=
  weight (offset p i j) - L p i j * pos (sq (plus (offset p i j) w) - sq (offset p i j)).

(* (far) of i for each robot j in range, normal or not: both sides are multiplied by 4 L. *)
Hypothesis far_own : forall p i j, i \notin A -> i != j -> in_range p i j ->
  4 * L p i j * (dot (offset p i j) (v p i) + sq (v p i)) <= loss gamma (b p i i) / share p i i.
Hypothesis far_for : forall p i j, i \notin A -> i != j -> in_range p i j ->
  4 * L p i j * (dot (offset p i j) (v p i) + sq (v p i)) <= loss gamma (b p i j) / share p i j.

(* The F robots with the largest weights for k, and T_k. *)
Variable strongest : nat -> V -> {set V}.
Hypothesis strongest_are : forall p k, largest k F (a p k) (strongest p k).
Definition T p k := outside k (a p k) (strongest p k).
Hypothesis start : forall k, k \notin A -> INR th <= T 0 k.

(* eq:known: what is seen is at most T_k (trimmed_mono). sec:shares: d_ik is at least the degree of k. *)
Hypothesis b_nonneg : forall p i k, 0 <= b p i k.
Hypothesis known : forall p i k, i \notin A -> k \notin A -> b p i k <= pos (T p k - INR th).
Definition degree p k := #|[set j | (j != k) && in_range p k j]|.
Hypothesis shares : forall p i k, i \notin A -> k \notin A -> INR (degree p k) <= share p i k.

Lemma minus_swap p i j : offset p j i = times (-1) (offset p i j).
Proof. by apply: functional_extensionality => c; rewrite /offset /minus /times; ring. Qed.

(* The offset when each robot has done the part t of its move. *)
Definition offset_at p t i j := moved (offset p i j) (times (t i) (v p i)) (times (t j) (v p j)).

Lemma offset_next p i j : i \notin A -> j \notin A -> offset_at p (fun _ => 1) i j = offset p.+1 i j.
Proof.
move=> iA jA; apply: functional_extensionality => c.
by rewrite /offset_at /moved /offset /plus /minus /times !moves // /plus; ring.
Qed.

Lemma done_part p i u : i \notin A -> 0 <= u <= 1 -> sq (times u (v p i)) <= rho * rho.
Proof.
move=> iA u01; have := sq_nonneg (v p i); have := longest p iA; rewrite sq_times.
move: (sq _) => z le z0; have : u * u <= 1 by nra.
nra.
Qed.

Section OneRobot.
Variable k : V.
Hypothesis kA : k \notin A.
(* The sum of the weights of k to robots outside of A'. *)
Definition S p A' := outside k (a p k) A'.
Definition S_at p t A' := outside k (fun j => weight (offset_at p t k j)) A'.

Lemma at_least_trimmed p A' : liars_among k A F A' -> T p k <= S p A'.
Proof. by move=> [_ kA' cardA']; exact: trimmed_least (strongest_are p k) kA' cardA'. Qed.

Lemma takes_its_share p A' t : liars_among k A F A' -> (forall i, 0 <= t i <= 1) ->
  S_at p t A' - INR th >= S p A' - INR th - loss gamma (pos (S p A' - INR th)).
Proof.
move=> among t01; have [sub kA' cardA'] := among.
pose C := ~: (k |: A'); pose N := [set j in C | in_range p k j].
have NC : N \subset C by apply/subsetP => j; rewrite inE => /andP [].
have normal j : j \in N -> [/\ j \notin A, k != j & in_range p k j].
  rewrite !inE negb_or => /andP [/andP [jk jA'] near]; split=> //; last by rewrite eq_sym.
  by apply: contra jA' => /(subsetP sub).
have out j : j \in C -> j \notin N -> weight (r k (x p) j) = 0.
  rewrite [j \in N]inE => -> /= far; apply: out_of_range; move: far; rewrite /in_range /offset /r.
  by case: (Rle_dec _ _) => // no _; exact: Rnot_le_lt.
have s0 c : 0 <= c -> 0 <= loss gamma c by move=> c0; have [] := loss_range gamma01 c0.
have mono c e : 0 <= c -> c <= e -> loss gamma c <= loss gamma e by exact: loss_mono.
have all_normal i : i \in k |: N -> i \notin A by rewrite in_setU1 => /orP [/eqP -> // | /normal []].
apply: (@far_tick V d k C N NC (x p) (v p) (fun _ => weight) _ out t t01 (INR th)
  (loss gamma) s0 mono (fun i => b p i k) (fun i => share p i k) _ _ (L p k)) => //.
- move=> i iN; split=> //; apply: Rle_trans (known p (all_normal i iN) kA) _.
  by apply: Rle_max_compat_r; exact: Rplus_le_compat_r (at_least_trimmed p among).
- move=> i iN; apply: Rle_trans (shares p (all_normal i iN) kA); apply: le_INR; apply/leP.
  by apply: subset_leq_card; apply/subsetP => j /normal [_ kj near]; rewrite inE eq_sym kj near.
- move=> j /normal [jA kj near]; rewrite /after /moved; apply: (falls kA jA near).
  have := sq_minus_le (times (t k) (v p k)) (times (t j) (v p j)).
  have := done_part p kA (t01 k); have := done_part p jA (t01 j); lra.
- by move=> j /normal [jA kj near]; exact: far_own.
- move=> j /normal [jA kj near]; have near' : in_range p j k.
    by move: near; rewrite /in_range [offset p j k]minus_swap sq_times; case: (Rle_dec _ _) => // le _; case: (Rle_dec _ _) => // no; case: no; lra.
  by have := far_for jA _ near'; rewrite eq_sym => /(_ kj); rewrite L_sym minus_swap.
Qed.

Lemma S_next p A' : liars_among k A F A' -> S_at p (fun _ => 1) A' = S p.+1 A'.
Proof.
move=> [sub _ _]; apply: eq_bigr => j; rewrite !inE negb_or => /andP [_ jA'].
by rewrite /a offset_next //; apply: contra jA' => /(subsetP sub).
Qed.

Lemma sums_stay p A' : liars_among k A F A' -> INR th <= S p A'.
Proof.
move=> among; suff : 0 <= S p A' - INR th by lra.
apply: (sensed gamma01 (h := fun p => S p A' - INR th) (used := fun p c => c <= pos (S p A' - INR th))) => //.
  by move=> q _; rewrite -S_next //; apply: takes_its_share => // i; lra.
by have := at_least_trimmed 0 among; have := start kA; lra.
Qed.

Lemma sums_stay_between p t A' : liars_among k A F A' -> (forall i, 0 <= t i <= 1) -> INR th <= S_at p t A'.
Proof.
move=> among t01; have hp := sums_stay p among; have := takes_its_share p among t01.
have h0 : 0 <= S p A' - INR th by lra.
by rewrite /pos Rmax_left; [have := loss_range gamma01 h0; lra | lra].
Qed.

(* thm:free, neighbours at a moment when each normal robot has done a part of its move *)
Theorem free_between p t : (forall i, 0 <= t i <= 1) ->
  (th + (F - #|A|) <= #|[set j | [&& j \notin A, j != k & (Rle_dec (sq (offset_at p t k j)) R2 : bool)]]|)%N.
Proof.
move=> t01; apply: leq_trans (normal_many (a := fun j => weight (offset_at p t k j)) kA few Fn th0 _ eps0 eps_small _ _) _ => //.
  by move=> A' among; exact: sums_stay_between.
apply/subset_leq_card/subsetP => j; rewrite !inE => /andP [/andP [-> ->]] /=.
case: (Rlt_dec _ _) => // w0 _; case: (Rle_dec _ _) => // no.
by have := out_of_range (Rnot_le_lt _ _ no); lra.
Qed.

(* thm:free, neighbours at ticks *)
Theorem free p : (th + (F - #|A|) <= #|[set j | [&& j \notin A, j != k & in_range p k j]]|)%N.
Proof.
apply: leq_trans (@free_between p (fun _ => 0) _) _ => [i|]; first by lra.
apply/subset_leq_card/subsetP => j; rewrite !inE => /and3P [-> ->] /=.
have -> // : offset_at p (fun _ => 0) k j = offset p k j.
by apply: functional_extensionality => c; rewrite /offset_at /moved /plus /minus /times; ring.
Qed.
End OneRobot.

(* thm:free, distances *)
Variables (gamma_c Dd : R).
Hypothesis gamma_c01 : 0 < gamma_c <= 1.
Hypothesis near : forall p i j, i \notin A -> i != j -> in_range p i j ->
  near_row gamma_c (Dd * Dd) (offset p i j) (v p i).
Hypothesis rho_nonneg : 0 <= rho.
Hypothesis Dd_nonneg : 0 <= Dd.
Hypothesis room : Dd <= radius - 2 * rho.

Theorem free_apart_between p i j t : i \notin A -> j \notin A -> i != j -> (forall i, 0 <= t i <= 1) ->
  Dd * Dd <= sq (offset p i j) -> Dd * Dd <= sq (offset_at p t i j).
Proof.
move=> iA jA ij t01; apply: (pair_stays_apart gamma_c01 rho_nonneg Dd_nonneg room) => //; try exact: longest.
move=> close; split; first by apply: near => //; rewrite /in_range; case: (Rle_dec _ _).
rewrite -minus_swap; apply: near => //; first by rewrite eq_sym.
by rewrite /in_range minus_swap sq_times; case: (Rle_dec _ _) => // no; case: no; move: close; rewrite /R2; lra.
Qed.

Theorem free_apart i j : i \notin A -> j \notin A -> i != j ->
  Dd * Dd <= sq (offset 0 i j) -> forall p, Dd * Dd <= sq (offset p i j).
Proof.
move=> iA jA ij apart; elim=> // p IH; rewrite -offset_next //.
by apply: free_apart_between => // k; lra.
Qed.
End Team.
