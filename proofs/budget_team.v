(* The controller budget: a whole team from its rows (docs/theory/budget.md, thm:sensed with (far')).

   In words. All robots, malicious ones too, move by (far') and (near). Each counts for each neighbour k on what it sees of it;
   what it counts on for a malicious k is anything that is not negative. Let h_k >= 0 for every normal k and all pairs be at least Dd apart at the start. Then at every tick, and at every moment between two
   ticks, h_k >= 0 for every normal k, and no pair is closer than Dd.

   Assumed of the weight: never negative, 0 out of range, and the curvature bound of eq:curvature-bound for moves of at most rho.
   Assumed of the settings: R - 2 rho >= Dd. *)

From Coq Require Import Reals Lra Psatz FunctionalExtensionality.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors budget loss budget_run.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Team.
Variable gamma : R.
Hypothesis gamma01 : 0 < gamma <= 1.
Variables (V : finType) (d : nat) (A : {set V}) (radius rho : R).
Let R2 := radius * radius.
Let rho2 := rho * rho.

(* Weight and gradient of a link at an offset. *)
Variables (weight : vec d -> R) (grad : vec d -> vec d).
Hypothesis weight_nonneg : forall r, 0 <= weight r.
Hypothesis out_of_range : forall r, R2 < sq r -> weight r = 0.
Hypothesis odd : forall r, grad (times (-1) r) = times (-1) (grad r).

(* Who counts for k, and how many it must keep (eq:need). *)
Variables (counts : V -> {set V}) (need : V -> R).

(* Positions and moves at ticks 0, 1, 2, ...; curvature bounds, what i counts on for k, and its share. *)
Variables (x v : nat -> V -> vec d) (kappa b share : nat -> V -> V -> R).
Hypothesis moves : forall p i, x p.+1 i = plus (x p i) (v p i).
Hypothesis longest : forall p i, sq (v p i) <= rho2.
Definition offset p i j : vec d := minus (x p i) (x p j).
Definition in_range p i j : bool := Rle_dec (sq (offset p i j)) R2.
(* The neighbours of k that count for it. *)
Definition N p k := [set j in counts k | in_range p k j].
Definition level p k := h k (counts k) (x p) (fun _ => weight) (need k).   (* this is h_k *)

Hypothesis kappa_nonneg : forall p i j, 0 <= kappa p i j.
Hypothesis kappa_sym : forall p i j, kappa p i j = kappa p j i.
(* eq:curvature-bound *)
Hypothesis bends : forall p i j w, in_range p i j -> sq w <= 4 * rho2 ->
  weight (plus (offset p i j) w) >= weight (offset p i j) + dot (grad (offset p i j)) w - kappa p i j / 2 * sq w.

(* (far') of i for itself, and for a neighbour k that it counts for. *)
Definition g_own p i : vec d := fun c => \big[Rplus/0]_(j in N p i) grad (offset p i j) c.
Definition kappa_own p i := \big[Rplus/0]_(j in N p i) kappa p i j.
Hypothesis far_own : forall p i,
  - dot (g_own p i) (v p i) + kappa_own p i * sq (v p i) <= loss gamma (b p i i) / (share p i i + 1).
Hypothesis far_for : forall p i k, i \in N p k ->
  - dot (grad (offset p i k)) (v p i) + kappa p i k * sq (v p i) <= loss gamma (b p i k) / (share p i k + 1).

(* sec:shares: d_ik is at least the degree of k. eq:known: what is seen. *)
Hypothesis shares : forall p i k, k \notin A -> i \in k |: N p k -> INR #|N p k| <= share p i k.
Hypothesis b_nonneg : forall p i k, 0 <= b p i k.
Hypothesis known : forall p i k, k \notin A -> i \in k |: N p k ->
  b p i k <= pos (level p k).

Lemma minus_swap p i j : offset p j i = times (-1) (offset p i j).
Proof. by apply: functional_extensionality => c; rewrite /offset /minus /times; ring. Qed.

Section Tick.
Variables (p : nat) (k : V).
Hypothesis kA : k \notin A.
Hypothesis true_b : forall i, i \in k |: N p k -> b p i k <= pos (level p k).
Variable t : V -> R.
Hypothesis t01 : forall i, 0 <= t i <= 1.

(* h_k when each robot has done the part t of its move. *)
Definition level_at := h' k (counts k) (x p) (v p) (fun _ => weight) t (need k).

Lemma takes_its_share : level_at >= level p k - loss gamma (pos (level p k)).
Proof.
have sub : N p k \subset counts k by apply/subsetP => j; rewrite inE => /andP [].
have out j : j \in counts k -> j \notin N p k -> weight (r k (x p) j) = 0.
  rewrite inE => -> /= far; apply: out_of_range; move: far; rewrite /in_range /offset /r.
  by case: (Rle_dec _ _) => // no _; exact: Rnot_le_lt.
have s0 c : 0 <= c -> 0 <= loss gamma c by move=> c0; have [] := loss_range gamma01 c0.
have mono c e : 0 <= c -> c <= e -> loss gamma c <= loss gamma e by exact: loss_mono.
apply: (@far_prime_tick V d k (counts k) (N p k) sub (x p) (v p) (fun _ => weight) _ out t t01 (need k)
  (loss gamma) s0 mono (fun i => b p i k) (fun i => share p i k) _ _
  (fun j => grad (offset p k j)) (kappa p k) rho2) => //.
- by move=> i iN; split=> //; exact: true_b.
- by move=> i iN; exact: shares.
- by move=> j w; rewrite inE => /andP [_ near]; exact: bends.
- exact: far_own.
- move=> j jN; have := far_for jN; rewrite minus_swap odd dot_times kappa_sym; lra.
Qed.
End Tick.

(* At the end of a tick all parts are 1. *)
Lemma level_next p k : level p.+1 k = level_at p k (fun _ => 1).
Proof.
rewrite /level /level_at /h /h'; congr (_ - _); apply: eq_bigr => j _; congr weight.
by apply: functional_extensionality => c; rewrite /after /moved /r /plus /minus /times !moves /plus; ring.
Qed.

(* thm:sensed, h at ticks *)
Theorem never_negative k : k \notin A -> 0 <= level 0 k -> forall p, 0 <= level p k.
Proof.
move=> kA start; apply: (sensed gamma01 (h := fun p => level p k)
  (used := fun p c => exists2 i, i \in k |: N p k & c = b p i k)) => //.
- move=> p ok; rewrite level_next; apply: takes_its_share => //; last by move=> i; lra.
  by move=> i iN; apply: ok; exists i.
- by move=> p c [i iN ->]; exact: known.
Qed.

(* thm:sensed, h between ticks *)
Theorem never_negative_between k : k \notin A -> 0 <= level 0 k -> forall p t,
  (forall i, 0 <= t i <= 1) -> 0 <= level_at p k t.
Proof.
move=> kA start p t t01; have all := never_negative kA start; have hp := all p.
have true_b i : i \in k |: N p k -> b p i k <= pos (level p k) by move=> iN; exact: known.
have := takes_its_share kA true_b t01; rewrite /pos Rmax_left; last exact: hp.
by have := loss_range gamma01 hp; lra.
Qed.

(* thm:sensed, distances. *)
Variables (gamma_c Dd : R).
Let Dd2 := Dd * Dd.
Hypothesis gamma_c01 : 0 < gamma_c <= 1.
Definition offset_at p t i j := moved (offset p i j) (times (t i) (v p i)) (times (t j) (v p j)).
Hypothesis near : forall p i j, i != j -> in_range p i j -> near_row gamma_c Dd2 (offset p i j) (v p i).
Hypothesis rho_nonneg : 0 <= rho.
Hypothesis Dd_nonneg : 0 <= Dd.
Hypothesis room : Dd <= radius - 2 * rho.

Theorem stay_apart_between p i j t : i != j -> (forall i, 0 <= t i <= 1) ->
  Dd2 <= sq (offset p i j) -> Dd2 <= sq (offset_at p t i j).
Proof.
move=> ij t01; apply: (pair_stays_apart gamma_c01 rho_nonneg Dd_nonneg room) => //; try exact: longest.
move=> close; split; first by apply: near => //; rewrite /in_range; case: (Rle_dec _ _).
rewrite -minus_swap; apply: near; first by rewrite eq_sym.
by rewrite /in_range minus_swap sq_times; case: (Rle_dec _ _) => // no; case: no; move: close; rewrite /R2; lra.
Qed.

Theorem stay_apart i j : i != j -> Dd2 <= sq (offset 0 i j) -> forall p, Dd2 <= sq (offset p i j).
Proof.
move=> ij start; elim=> // p IH.
have one : forall k : V, 0 <= (fun _ => 1) k <= 1 by move=> k; lra.
have := stay_apart_between ij one IH.
have -> // : offset_at p (fun _ => 1) i j = offset p.+1 i j.
by apply: functional_extensionality => c; rewrite /offset_at /moved /offset /plus /minus /times !moves /plus; ring.
Qed.
End Team.
