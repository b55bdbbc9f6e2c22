(* What may be lost in a tick, and what is left after some (docs/theory/budget.md: eq:loss, eq:decayed).

   In words. s(h) = gamma h (1 + q h)/(1 + gamma q h) lies between 0 and h and never falls; what m ticks leave of h is at least
   left(h, m) = g h/(1 + q (1 - g) h) with g = (1 - gamma)^m; it never falls with h either, and m ticks after k ticks are
   k + m ticks. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Loss.
Variables gamma q : R.
Hypothesis gamma01 : 0 < gamma <= 1.
Hypothesis q0 : 0 <= q.

Definition loss (h : R) := gamma * h * (1 + q * h) / (1 + gamma * q * h).
Definition part (g h : R) := g * h / (1 + q * (1 - g) * h).
Definition decayed (m : nat) (h : R) := part ((1 - gamma) ^ m) h.

Lemma loss_bottom h : 0 <= h -> 0 < 1 + gamma * q * h.
Proof. by move=> h0; have : 0 <= gamma * q * h; [apply: Rmult_le_pos => //; nra | lra]. Qed.

Lemma part_bottom g h : 0 <= g <= 1 -> 0 <= h -> 0 < 1 + q * (1 - g) * h.
Proof. by move=> g01 h0; have : 0 <= q * (1 - g) * h; [apply: Rmult_le_pos => //; nra | lra]. Qed.

Lemma div_le a b c d : 0 < b -> 0 < d -> a * d <= c * b -> a / b <= c / d.
Proof.
move=> b0 d0 le; apply: (Rmult_le_reg_r (b * d)); first exact: Rmult_lt_0_compat.
have -> : a / b * (b * d) = a * d by field; lra.
by have -> : c / d * (b * d) = c * b by field; lra.
Qed.

(* eq:loss *)
Lemma loss_range h : 0 <= h -> 0 <= loss h <= h.
Proof.
move=> h0; have bot := loss_bottom h0; split.
  apply: Rmult_le_pos; last by apply/Rlt_le/Rinv_0_lt_compat.
  by apply: Rmult_le_pos; nra.
have -> : h = h / 1 by field.
rewrite {1}/loss; have -> : h / 1 = h by field.
apply: (Rmult_le_reg_r (1 + gamma * q * h)) => //.
have -> : gamma * h * (1 + q * h) / (1 + gamma * q * h) * (1 + gamma * q * h) = gamma * h * (1 + q * h).
  by field; lra.
nra.
Qed.

(* eq:loss *)
Lemma loss_mono h k : 0 <= h -> h <= k -> loss h <= loss k.
Proof.
move=> h0 hk; have k0 : 0 <= k by lra.
apply: div_le; [exact: loss_bottom | exact: loss_bottom |].
have g0 : 0 <= gamma by lra.
have e1 : 0 <= gamma * (k - h) by apply: Rmult_le_pos; lra.
have e2 : 0 <= gamma * q * ((k - h) * (k + h)) by apply: Rmult_le_pos; [nra | apply: Rmult_le_pos; lra].
have e3 : 0 <= gamma * gamma * (q * q) * (h * k) * (k - h).
  by apply: Rmult_le_pos; [apply: Rmult_le_pos; [nra | nra] | lra].
nra.
Qed.

Lemma loss_0 : loss 0 = 0.
Proof. by rewrite /loss; field; lra. Qed.

Lemma part_mono g h k : 0 <= g <= 1 -> 0 <= h -> h <= k -> part g h <= part g k.
Proof.
move=> g01 h0 hk; have k0 : 0 <= k by lra.
apply: div_le; [exact: part_bottom | exact: part_bottom |].
have : 0 <= g * (k - h) by apply: Rmult_le_pos; lra.
nra.
Qed.

Lemma part_nonneg g h : 0 <= g <= 1 -> 0 <= h -> 0 <= part g h.
Proof.
move=> g01 h0; apply: Rmult_le_pos; first nra.
by apply/Rlt_le/Rinv_0_lt_compat/part_bottom.
Qed.

Lemma part_part g g' h : 0 <= g <= 1 -> 0 <= g' <= 1 -> 0 <= h -> part g' (part g h) = part (g * g') h.
Proof.
move=> g01 g01' h0; rewrite /part; field.
have b1 := part_bottom g01 h0.
have gg : 0 <= g * g' <= 1 by nra.
have b2 := part_bottom gg h0; split; lra.
Qed.

(* One tick leaves h - s(h). *)
Lemma loss_is_part h : 0 <= h -> h - loss h = part (1 - gamma) h.
Proof.
move=> h0; rewrite /loss /part; have := loss_bottom h0; move=> bot; field.
have -> : 1 + q * (1 - (1 - gamma)) * h = 1 + gamma * q * h by ring.
lra.
Qed.

Lemma power_range m : 0 <= (1 - gamma) ^ m <= 1.
Proof. by elim: m => [|m IH] /=; nra. Qed.

(* eq:decayed *)
Lemma decayed_0 h : decayed 0 h = h.
Proof. by rewrite /decayed /part /=; field; lra. Qed.

Lemma decayed_S m h : 0 <= h -> decayed m.+1 h = part (1 - gamma) (decayed m h).
Proof.
move=> h0; rewrite /decayed part_part //; [|exact: power_range | lra].
by congr part; rewrite /= Rmult_comm.
Qed.

Lemma decayed_nonneg m h : 0 <= h -> 0 <= decayed m h.
Proof. by move=> h0; apply: part_nonneg => //; exact: power_range. Qed.
End Loss.
