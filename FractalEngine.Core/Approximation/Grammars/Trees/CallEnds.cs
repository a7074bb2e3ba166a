using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>
/// Turns the frames of recursives so that what stands at the ends of the last level is the same for all of them, and finds which recursives
/// are called on the level before, where only ends tell of it.
/// </summary>
internal sealed class CallEnds
{
    private const int MaxLeaves = 64;

    private readonly CallScene _scene;
    private CallExpansion _expansion;
    private CallRule[] _rules;
    private readonly bool[] _isLeft;
    private readonly bool[] _isCovered;
    private readonly List<(int Class, AffineMap Placement)> _leaves = [];

    private CallEnds(CallScene scene, CallExpansion expansion, CallRule[] rules)
    {
        _scene = scene;
        _expansion = expansion;
        _rules = [.. rules];
        _isCovered = new bool[expansion.IsExplained.Length];
        _isLeft = new bool[_isCovered.Length];
        foreach (var member in scene.Group.Members)
        {
            _isLeft[member] = !expansion.IsExplained[member];
        }
    }

    /// <summary>Returns calls that make the same parts, and the same leaves at all ends, as far as there are such.</summary>
    public static CallRule[] Align(CallScene scene, CallExpansion expansion, CallRule[] rules)
    {
        var ends = new CallEnds(scene, expansion, rules);
        return ends._isLeft.Contains(true) ? ends.Align() : rules;
    }

    private CallRule[] Align()
    {
        var reference = Enumerable.Range(0, _rules.Length).OrderBy(rule => _rules[rule].Called)
            .FirstOrDefault(rule => EndsOf(rule).Count > 0, -1);
        if (reference >= 0)
        {
            FindLeaves(EndsOf(reference));
        }
        else
        {
            GuessLeaves();
        }

        if (_leaves.Count > 0)
        {
            for (var rule = 0; rule < _rules.Length; rule++)
            {
                Resolve(rule);
            }

            foreach (var rule in Enumerable.Range(0, _rules.Length).Where(IsOpen).ToArray())
            {
                AddCalls(rule);
            }
        }

        return _rules;
    }

    /// <summary>Of two levels only the first one has parts: one of these is called by the whole, as others of these are.</summary>
    private void GuessLeaves()
    {
        for (var rule = 0; rule < _rules.Length && _leaves.Count == 0; rule++)
        {
            var known = _rules[rule];
            foreach (var symmetry in _scene.Symmetries.TakeWhile(_ => _leaves.Count == 0))
            {
                _rules[rule] = known with { Map = known.Map * symmetry, Called = 0 };
                FindLeaves([.. _rules.Where(other => other.Caller == 0).Select(other => _rules[rule].Map * other.Map)]);
            }

            _rules[rule] = _leaves.Count == 0 ? known : _rules[rule];
        }
    }

    private bool IsOpen(int rule) => !Array.Exists(_rules, other => other.Caller == _rules[rule].Called);

    private void Cover(IEnumerable<AffineMap> ends)
    {
        foreach (var end in ends)
        {
            foreach (var (kind, placement) in _leaves)
            {
                _isCovered[_scene.Group.Set.Find(end * placement, kind)] = true;
            }
        }
    }

    /// <summary>The frames that a call would lead to beyond the last level.</summary>
    private List<AffineMap> EndsOf(int rule) => [.. _expansion.Parts
        .Where(part => part.Level == _expansion.Depth && part.Recursive == _rules[rule].Caller)
        .Select(part => part.Frame * _rules[rule].Map)];

    /// <summary>Finds what stands at the ends of a call and, with turned frames, of all others.</summary>
    private void FindLeaves(List<AffineMap> ends)
    {
        var elements = _scene.Group.Set.Elements;
        var (back, tip) = (ends[0].Inverse(), ends[0] * elements[_scene.Root].Shape.Centroid);
        foreach (var element in Enumerable.Range(0, _isLeft.Length).Where(element => _isLeft[element])
            .OrderBy(element => (elements[element].Shape.Centroid - tip).LengthSquared()).ThenBy(element => element).Take(MaxLeaves))
        {
            var leaf = (elements[element].Class, back * elements[element].Placement);
            if (_isCovered[element] || !ends.TrueForAll(end => HasLeaf(end, leaf)))
            {
                continue;
            }

            var (before, expansion) = ((CallRule[])_rules.Clone(), _expansion);
            _leaves.Add(leaf);
            if (!_rules.Select(rule => rule.Called).Distinct().Order().ToArray().All(Turn))
            {
                before.CopyTo(_rules, 0);
                _expansion = expansion;
                _leaves.RemoveAt(_leaves.Count - 1);
                continue;
            }

            Cover(Enumerable.Range(0, _rules.Length).SelectMany(EndsOf));
        }
    }

    private bool HasLeaf(AffineMap end, (int Class, AffineMap Placement) leaf) =>
        _scene.Group.Set.Find(end * leaf.Placement, leaf.Class) is var found && found >= 0 && _isLeft[found];

    private bool HasLeaves(AffineMap end) => _leaves.Count > 0 && _leaves.TrueForAll(leaf => HasLeaf(end, leaf));

    /// <summary>Turns the frame of a recursive, with all calls of it and all its own ones.</summary>
    private bool Turn(int called)
    {
        var calls = Enumerable.Range(0, _rules.Length).Where(rule => _rules[rule].Called == called).ToArray();
        var ends = calls.Select(EndsOf).ToArray();
        var first = Array.FindIndex(ends, frames => frames.Count > 0);
        if (first < 0)
        {
            return true;
        }

        // The frame of the whole stays as it is.
        foreach (var turn in _scene.Symmetries.Take(called == 0 ? 1 : int.MaxValue).Where(
            turn => ends[first].TrueForAll(end => HasLeaves(end * turn))))
        {
            var back = turn.Inverse();
            var turned = Array.ConvertAll(_rules, rule => rule.Caller == called ? rule with { Map = back * rule.Map } : rule);
            var symmetries = calls.Select((rule, index) => _scene.Symmetries.Select(symmetry => (AffineMap?)symmetry).FirstOrDefault(
                symmetry =>
                ends[index].TrueForAll(end => HasLeaves(end * symmetry!.Value)) && KeepsCalls(turned, rule, symmetry!.Value))).ToArray();
            if (Array.TrueForAll(symmetries, symmetry => symmetry is not null))
            {
                for (var index = 0; index < calls.Length; index++)
                {
                    turned[calls[index]] = turned[calls[index]] with { Map = turned[calls[index]].Map * symmetries[index]!.Value };
                }

                if (CallExpansion.Create(_scene, turned, isWhole: true) is { } expansion && expansion.Parts.Count == _expansion.Parts.Count)
                {
                    turned.CopyTo(_rules, 0);
                    _expansion = expansion;
                    return true;
                }
            }
        }

        return false;
    }

    private bool KeepsCalls(CallRule[] turned, int rule, AffineMap symmetry) => _expansion.Parts
        .FirstOrDefault(part => part.Rule == rule && part.Level < _expansion.Depth, _expansion.Parts[^1]) is var part
        && (part.Rule != rule || part.Level == _expansion.Depth || _scene.HasCalls(turned, turned[rule].Called, part.Frame * symmetry));

    /// <summary>Finds which recursive a call calls whose parts are all on the last level.</summary>
    private void Resolve(int rule)
    {
        var parts = _expansion.Parts.FindAll(part => part.Rule == rule);
        foreach (var called in _rules.Select(other => other.Caller).Distinct().Order().Where(_ => IsOpen(rule)).ToArray())
        {
            var calls = Array.FindAll(_rules, other => other.Caller == called);
            foreach (var symmetry in _scene.Symmetries)
            {
                var ends = parts.SelectMany(part => calls.Select(call => part.Frame * symmetry * call.Map)).ToList();
                if (ends.TrueForAll(HasLeaves))
                {
                    Cover(ends);
                    _rules[rule] = new(_rules[rule].Caller, _rules[rule].Map * symmetry, called);
                    break;
                }
            }
        }
    }

    /// <summary>Finds the calls of a recursive that lead to leaves alone.</summary>
    private void AddCalls(int rule)
    {
        var parts = _expansion.Parts.FindAll(part => part.Rule == rule);
        if (parts.Count == 0 || parts.Exists(part => part.Level < _expansion.Depth))
        {
            return;
        }

        var set = _scene.Group.Set;
        var others = _expansion.Parts.FindAll(part => part.Rule >= 0 && IsOpen(part.Rule));
        var (back, (kind, placement)) = (parts[0].Frame.Inverse(), _leaves[0]);
        var called = _rules[rule].Called;
        foreach (var element in Enumerable.Range(0, _isLeft.Length).Where(
            element => _isLeft[element] && set.Elements[element].Class == kind
                && others.MinBy(part => Nearness(part, element)).Rule == rule))
        {
            foreach (var symmetry in set.SymmetriesOf(kind).TakeWhile(_ => !_isCovered[element]))
            {
                var map = back * set.Elements[element].Placement * symmetry * placement.Inverse();
                var ends = parts.ConvertAll(part => part.Frame * map);
                if (ends.TrueForAll(HasLeaves))
                {
                    // Which recursive is called makes no difference, where leaves end all levels.
                    Cover(ends);
                    _rules = [.. _rules, new(called, map, called)];
                }
            }
        }
    }

    private double Nearness(CallPart part, int element) =>
        (_scene.Group.Set.Elements[part.Element].Shape.Centroid - _scene.Group.Set.Elements[element].Shape.Centroid).Length()
        / _scene.SizeOf(part.Element);
}
