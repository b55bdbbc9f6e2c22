"""Robustness of a graph as a MILP and as a SAT problem; `heard[v]` lists the nodes that v hears, N(v).

    python forms.py (milp|sat) (r_max|f_max) GRAPH6    the answer, and the median seconds of a run

Both find k, the least level of disjoint nonempty S1, S2 with exempt nodes Y1 in S1, Y2 in S2, not all of either:

    for r_max:  the largest |N(v) \\ S| of a v in S = S1, S2                          without exempt nodes
    for f_max:  the larger of |Y1| + |Y2| and the largest |N(v) \\ S| of a v that is not exempt

A pair violates (r,s)-robustness (the paper's def:robustness) exactly if exempting its X^r_S1 and X^r_S2, at most s - 1
nodes, leaves a node in each set. So the first question that fails is (k+1, 1) or (k+1, k+1): r_max = k, F_max = k - 1.
"""

import statistics
import sys
import time

import highspy
from pysat.card import ITotalizer
from pysat.formula import IDPool
from pysat.solvers import Cadical195


def milp(heard, with_exempt):
    """The program of Usevitch and Panagou for HiGHS on one thread; a function that solves it and returns k.

    Source: "Determining r- and (r,s)-robustness of digraphs using mixed integer linear programming", Automatica 2020,
    arXiv:1901.11000; written anew from the definition. L is the Laplacian (L_vv = |N(v)|, L_vu = -1 for u in N(v)),
    b_k says who is in S_k, y_k who is in Y_k. Row v of L b_k is |N(v) \\ S_k| for v in S_k, else not positive.

        minimise   t                        t >= 0, whole
        subject to L b_k <= t 1 + D y_k     D = diag |N(v)|, the smallest constants that free a row;  k = 1, 2
                   b_1 + b_2 <= 1           b_k, y_k in {0,1}^n;  y_k = 0 for r_max
                   1'b_k - 1'y_k >= 1,      1'y_1 + 1'y_2 <= t
    """
    highs = highspy.Highs()
    highs.silent()
    highs.setOptionValue("threads", 1)
    level = highs.addIntegral(obj=1)
    sets, exempt = ([[highs.addBinary() for _ in heard] for _ in (1, 2)] for _ in "by")
    for members, exempted in zip(sets, exempt):
        for node, others in enumerate(heard):
            outside = len(others) * members[node] - highs.qsum(members[other] for other in others)
            highs.addConstr(outside <= level + len(others) * exempted[node])
        highs.addConstr(highs.qsum(members) - highs.qsum(exempted) >= 1)
    for first, second in zip(*sets):
        highs.addConstr(first + second <= 1)
    highs.addConstr(highs.qsum(exempt[0] + exempt[1]) <= (level if with_exempt else 0))

    def solve():
        highs.run()
        assert highs.getModelStatus() == highspy.HighsModelStatus.kOptimal, highs.getModelStatus()
        return round(highs.getInfo().objective_function_value)

    return solve


def sat(heard, with_exempt):
    """Clauses for CaDiCaL, with totalizers that count; a function that solves them and returns k.

    Assuming the literal permit[k] asks for sets of level at most k. Asked from above: the level
    min(ceil(n/2), max(least degree, 1)) always exists (Lemma 4 of LeBlanc and others; one node against all others).

        v is not in S_1 and in S_2;   node 0 is not in S_2 (the sets may be swapped)
        some v is held in S_k;        held means a member that is not exempt
        permit[k], v in S, v not exempt  =>  not more than k of N(v) are outside of S
        permit[k]                        =>  not more than k are exempt
    """
    count = len(heard)
    known = min((count + 1) // 2, max(1, min(map(len, heard))))
    ids, solver = IDPool(), Cadical195()
    permit = [ids.id(("permit", level)) for level in range(known)]
    member, exempt, held = (
        [[ids.id((name, side, node)) for node in range(count)] for side in (0, 1)] for name in ("in", "exempt", "held")
    )

    def count_up_to_permit(literals, unless=()):
        counter = ITotalizer(lits=literals, ubound=known - 1, top_id=ids.top)
        ids.top = max(ids.top, counter.top_id)
        solver.append_formula(counter.cnf.clauses)
        for level, more in zip(permit, counter.rhs):
            solver.add_clause([-level, -more, *unless])
        counter.delete()

    for first, second in zip(*member):
        solver.add_clause([-first, -second])
    solver.add_clause([-member[1][0]])
    for side in (0, 1):
        solver.add_clause(held[side])
        for node, others in enumerate(heard):
            solver.add_clause([-held[side][node], member[side][node]])
            solver.add_clause([-held[side][node], -exempt[side][node]])
            solver.add_clause([-exempt[side][node], member[side][node] if with_exempt else -exempt[side][node]])
            if others:
                outside = [-member[side][other] for other in others]
                count_up_to_permit(outside, unless=[-member[side][node], exempt[side][node]])
    if with_exempt:
        count_up_to_permit(exempt[0] + exempt[1])

    def solve():
        level = known
        while level > 0 and solver.solve(assumptions=[permit[level - 1]]):
            level -= 1
        return level

    return solve


def run(form, question, heard, patience_s=0.2):
    """(answer, median seconds of the solver alone); as in examples/compare.rs no repeat begins after `patience_s`."""
    began, answers, seconds = time.perf_counter(), set(), []
    while len(seconds) < 11 and (not seconds or time.perf_counter() - began < patience_s):
        solve = {"milp": milp, "sat": sat}[form](heard, with_exempt=question == "f_max")
        start = time.perf_counter()
        answers.add(solve() - (question == "f_max"))
        seconds.append(time.perf_counter() - start)
    (answer,) = answers
    return answer, statistics.median(seconds)


def neighbors_of(graph6):
    """Neighbours of each node of an undirected graph of at most 62 nodes."""
    count, *groups = (ord(byte) - 63 for byte in graph6)
    bits = (group >> place & 1 for group in groups for place in range(5, -1, -1))
    edges = [(u, v) for v in range(count) for u in range(v) if next(bits)]
    return [[u + v - node for u, v in edges if node in (u, v)] for node in range(count)]


if __name__ == "__main__":
    print(*run(sys.argv[1], sys.argv[2], neighbors_of(sys.argv[3])))
