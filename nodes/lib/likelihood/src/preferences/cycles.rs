//! Cycles of strict preferences: no ranking agrees with all of them, though the likelihood does not mind.

use std::collections::VecDeque;

use super::{Answer, Verdict};

/// Edges looked at in search of a shorter cycle of one component; only components of tens of thousands of answers need more.
const PATIENCE: usize = 20_000_000;

/// One shortest cycle of each strongly connected component of the strict preferences, smallest item first, components by
/// that item: `[a, b, c]` says that b is preferred to a, c to b, and a to c. Empty where some ranking agrees with every answer.
///
/// In a component of very many answers the cycle is a short one, the shortest that a bounded search found.
pub fn cycles(answers: &[Answer]) -> Vec<Vec<usize>> {
    let graph = Graph::new(answers);
    let component = components(&graph);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); graph.items.len()];
    for (node, &component) in component.iter().enumerate() {
        members[component].push(node);
    }
    let mut found: Vec<Vec<usize>> = members
        .iter()
        .filter(|members| members.len() > 1)
        .map(|members| {
            let mut cycle = shortest_cycle(&graph, &component, members);
            cycle.iter_mut().for_each(|node| *node = graph.items[*node]);
            let smallest = (0..cycle.len()).min_by_key(|&position| cycle[position]).unwrap_or(0);
            cycle.rotate_left(smallest);
            cycle
        })
        .collect();
    found.sort();
    found
}

/// Edges from the worse to the better of each strict answer, without repeats, over nodes numbered anew.
struct Graph {
    /// Item of each node, ascending.
    items: Vec<usize>,
    edges: Vec<usize>,
    /// The edges of node i are `edges[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
}

impl Graph {
    fn new(answers: &[Answer]) -> Self {
        let strict = || answers.iter().filter(|answer| answer.verdict == Verdict::Strict);
        let mut items: Vec<usize> = strict().flat_map(|answer| [answer.less, answer.more]).collect();
        items.sort_unstable();
        items.dedup();
        let node = |item| items.partition_point(|&other| other < item);
        let mut pairs: Vec<(usize, usize)> = strict().map(|answer| (node(answer.less), node(answer.more))).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let starts = (0..=items.len()).map(|node| pairs.partition_point(|&(less, _)| less < node)).collect();
        Self { edges: pairs.into_iter().map(|(_, more)| more).collect(), items, starts }
    }

    fn better(&self, node: usize) -> &[usize] {
        &self.edges[self.starts[node]..self.starts[node + 1]]
    }
}

/// Strongly connected component of each node (Tarjan 1972, without recursion).
fn components(graph: &Graph) -> Vec<usize> {
    const UNSEEN: usize = usize::MAX;
    let n = graph.items.len();
    let (mut order, mut low, mut component) = (vec![UNSEEN; n], vec![0; n], vec![UNSEEN; n]);
    let (mut n_seen, mut n_components) = (0, 0);
    let mut open: Vec<usize> = Vec::new();
    // Nodes on the way, each with the number of its edges already followed.
    let mut path: Vec<(usize, usize)> = Vec::new();
    for root in 0..n {
        if order[root] == UNSEEN {
            path.push((root, 0));
        }
        while let Some((node, followed)) = path.pop() {
            if followed == 0 {
                (order[node], low[node]) = (n_seen, n_seen);
                n_seen += 1;
                open.push(node);
            } else {
                let child = graph.better(node)[followed - 1];
                if component[child] == UNSEEN {
                    low[node] = low[node].min(low[child]);
                }
            }
            if let Some(&next) = graph.better(node).get(followed) {
                path.push((node, followed + 1));
                if order[next] == UNSEEN {
                    path.push((next, 0));
                }
            } else if low[node] == order[node] {
                while let Some(member) = open.pop() {
                    component[member] = n_components;
                    if member == node {
                        break;
                    }
                }
                n_components += 1;
            }
        }
    }
    component
}

/// A shortest cycle within a strongly connected component of at least two nodes: breadth first from each of its nodes.
fn shortest_cycle(graph: &Graph, component: &[usize], members: &[usize]) -> Vec<usize> {
    const UNSEEN: usize = usize::MAX;
    let mut shortest: Vec<usize> = Vec::new();
    let mut from = vec![UNSEEN; graph.items.len()];
    let mut distance = vec![0; graph.items.len()];
    let mut patience = PATIENCE;
    for &start in members {
        let mut queue = VecDeque::from([start]);
        let mut reached = vec![start];
        from[start] = start;
        distance[start] = 0;
        'search: while let Some(node) = queue.pop_front() {
            // A cycle over this node has at least one more item than its distance.
            if !shortest.is_empty() && distance[node] + 1 >= shortest.len() {
                break;
            }
            for &next in graph.better(node) {
                patience = patience.saturating_sub(1);
                if next == start {
                    shortest = trace(&from, node);
                    break 'search;
                }
                if component[next] == component[start] && from[next] == UNSEEN {
                    from[next] = node;
                    distance[next] = distance[node] + 1;
                    reached.push(next);
                    queue.push_back(next);
                }
            }
        }
        for node in reached {
            from[node] = UNSEEN;
        }
        if shortest.len() == 2 || patience == 0 {
            break;
        }
    }
    shortest
}

/// The way from the start of a search to `last`; the start comes from itself.
fn trace(from: &[usize], last: usize) -> Vec<usize> {
    let mut way = vec![last];
    let mut node = last;
    while from[node] != node {
        node = from[node];
        way.push(node);
    }
    way.reverse();
    way
}
