using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>The parts of a fractal while it is described: base meshes, steps on earlier parts, sums and recursives.</summary>
/// <remarks>
/// Parts are added in any order of use, equal ones once, and known by their indices. <see cref="Describe"/> keeps those that the whole
/// is made of.
/// </remarks>
/// <param name="keepsSums">
/// True where chance decides about something, which numbers terms and maps as they are written: sums of sums stay so, and sets on one
/// object are one term.
/// </param>
public sealed class FractalPartList(bool keepsSums = false)
{
    // A repetition of what a recursive calls is made of calls, one for each level.
    private const int MaxUnrolledLevels = 10_000;

    // More are parts of their own, so that sums of sums don't multiply. What has calls stands in one body only.
    private const int MaxInlined = 8;

    private readonly List<Entry> _entries = [];
    private readonly Dictionary<Entry, int> _known = [];

    /// <summary>Adds a base mesh, as a part that others can be made of.</summary>
    /// <param name="mesh">Number of the mesh, by which <see cref="Describe"/> lists it.</param>
    /// <returns>Index of the part.</returns>
    public int AddMesh(int mesh) => Add(new(null, mesh, null));

    /// <summary>Adds a call, for the body of a recursive: its own one, or that of another one of the same group.</summary>
    /// <param name="recursive">Index of the recursive in the group.</param>
    /// <returns>Index of the part.</returns>
    public int AddCall(int recursive) => Add(new(null, null, recursive));

    /// <summary>Adds what steps make of an earlier part.</summary>
    /// <param name="inner">Index of the part.</param>
    /// <param name="steps">The outermost first; without any, the part itself is meant.</param>
    /// <returns>Index of the part.</returns>
    /// <remarks>Steps on steps are one part, as they are where a file has both.</remarks>
    public int AddSteps(int inner, ImmutableArray<FractalStep> steps) => steps.IsEmpty ? inner
        : _entries[inner].Part is SteppedPart below ? AddSteps(below.Inner, steps.AddRange(below.Steps))
        : Add(new(new SteppedPart(inner, steps), null, null));

    /// <summary>Adds several parts at one place.</summary>
    /// <param name="terms">Indices of the parts, at least one.</param>
    /// <param name="isWhole">Tells by its position whether a term is one thing, such as a name, though it be a set on something.</param>
    /// <returns>Index of the part.</returns>
    public int AddSum(ImmutableArray<int> terms, Func<int, bool>? isWhole = null)
    {
        if (terms is [var only])
        {
            return only;
        }

        ImmutableArray<RecursiveCall> calls = [.. terms.SelectMany((term, index) => CallsOf(term, isWhole?.Invoke(index) == true))];
        return calls switch
        {
            [] => terms[0],
            [{ IsConstant: true } one] => one.IsPlain ? one.Target
                : AddSteps(one.Target, [new TransformationSet([one.Map], [one.Colour])]),
            _ => Add(new(RecursivePart.Sum(calls), null, null)),
        };
    }

    /// <summary>Adds a choice between several parts: one of them stands there, by chance.</summary>
    /// <param name="alternatives">Indices of the parts.</param>
    /// <param name="choice">A weight for each.</param>
    /// <param name="isOfBody">True where it is written in the body of a recursive, whose levels it counts then.</param>
    /// <returns>Index of the part.</returns>
    /// <exception cref="ArgumentException">There are more or fewer weights.</exception>
    public int AddChoice(ImmutableArray<int> alternatives, Choice choice, bool isOfBody = false)
    {
        FractalRecursive one = new(alternatives[0], [.. alternatives.Select(RecursiveCall.ToPart)]) { Choice = choice };
        return Add(new(new RecursivePart([one], 0, 1), null, null) { CountsLevels = isOfBody && choice.IsByLevel });
    }

    /// <summary>Adds a recursive, see <see cref="CreateRecursives"/>.</summary>
    /// <param name="recursives">The recursives of its group.</param>
    /// <param name="root">Its index in the group.</param>
    /// <param name="levels">Number of its levels; null for no limit.</param>
    /// <param name="until">The length at which it ends; null for none. See <see cref="RecursivePart"/>.</param>
    /// <returns>Index of the part.</returns>
    public int AddRecursive(ImmutableArray<FractalRecursive> recursives, int root, int? levels, double? until = null) =>
        Add(new(new RecursivePart(recursives, root, levels, until), null, null));

    /// <summary>Adds all that a description is made of.</summary>
    /// <param name="description">The description.</param>
    /// <param name="partOfMesh">Gives the index of the part that stands for one of its base meshes.</param>
    /// <returns>Index of the part that is the whole.</returns>
    public int AddAll(FractalDescription description, Func<int, int> partOfMesh)
    {
        ArgumentNullException.ThrowIfNull(description);
        var indices = Enumerable.Range(0, description.MeshCount).Select(partOfMesh).ToList();
        foreach (var part in description.Parts)
        {
            indices.Add(part switch
            {
                SteppedPart { Inner: var inner, Steps: var steps } => AddSteps(indices[inner], steps),
                RecursivePart { IsSum: true, Recursives: [{ Calls: { IsEmpty: false } calls }] } => AddTerms(calls, indices),
                _ => Add(new(part.WithReferences(index => indices[index]), null, null)),
            });
        }

        return AddSteps(indices[^1], description.Steps);
    }

    /// <summary>
    /// Adds the calls of a sum as terms, so that it is the same as if it had been written of what its base meshes stand for: calls of the
    /// same part after each other are a set, unless that is all.
    /// </summary>
    private int AddTerms(ImmutableArray<RecursiveCall> calls, List<int> indices)
    {
        var terms = new List<(int Part, bool IsPlain)>();
        var isOneTarget = calls.All(call => call.HasTargetOf(calls[0]));
        for (var i = 0; i < calls.Length;)
        {
            RecursiveCall[] set = [.. calls.Skip(i).Take(isOneTarget && i == 0 ? 1 : MaxInlined)
                .TakeWhile(call => call.HasTargetOf(calls[i]))];
            var isPlain = set is [{ IsPlain: true }];
            terms.Add((AddSteps(indices[set[0].Target], isPlain ? [] :
                [new TransformationSet([.. set.Select(static call => call.Map)], [.. set.Select(static call => call.Colour)])]), isPlain));
            i += set.Length;
        }

        return AddSum([.. terms.Select(static term => term.Part)], index => terms[index].IsPlain);
    }

    /// <summary>Makes the recursives of a group, which call themselves and each other in their bodies.</summary>
    /// <param name="bases">What each is without levels, by indices of parts.</param>
    /// <param name="bodies">
    /// What each is with levels, by indices of parts: calls (see <see cref="AddCall"/>), sets on calls, sums of such, and anything that
    /// has no calls.
    /// </param>
    /// <param name="isWhole">As for a sum, for bodies.</param>
    /// <exception cref="ArgumentException">
    /// A base has calls, or a body has calls within a recursive, or within a repetition without end or of too many levels.
    /// </exception>
    public ImmutableArray<FractalRecursive> CreateRecursives(
        ImmutableArray<int> bases, ImmutableArray<int> bodies, Func<int, bool>? isWhole = null)
    {
        ArgumentCheck.Require(!bases.Any(HasCalls), "expected bases without calls", nameof(bases));
        var recursives = new List<FractalRecursive>(bases.Select(static part => new FractalRecursive(part, [])));
        var named = new Dictionary<int, RecursiveCall>();
        var unnamedCalls = new Dictionary<FractalRecursive, RecursiveCall>();
        var unnamed = new FractalRecursive(bases[0], []);
        for (var i = 0; i < bodies.Length; i++)
        {
            recursives[i] = isWhole?.Invoke(i) == true && !IsOfBody(bodies[i])
                ? recursives[i] with { Calls = CallsOf(bodies[i], isWhole: true) }
                : BodyOf(recursives[i], bodies[i]);
        }

        return [.. recursives];

        // What is by chance in a body is a recursive of its own, and each of its alternatives that is more than a call.
        FractalRecursive BodyOf(FractalRecursive recursive, int part) =>
            _entries[part].Part is RecursivePart { IsFlat: true, Recursives: [{ Choice: { } choice } one] }
                ? recursive with { Choice = choice, Calls = [.. one.Calls.Select(call => NamePart(call.Target))] }
                : recursive with { Calls = Expand(part) };

        RecursiveCall NamePart(int part) => !IsOfBody(part) ? RecursiveCall.ToPart(part)
            : _entries[part].Call is { } call ? new(AffineMap.Identity, call)
            : named.TryGetValue(part, out var known) ? known
            : named[part] = Name(BodyOf(unnamed, part));

        ImmutableArray<RecursiveCall> Expand(int part) => _entries[part] switch
        {
            { Call: { } call } => [new(AffineMap.Identity, call)],
            _ when !IsOfBody(part) && !(keepsSums && IsSum(part)) => CallsOf(part),
            { Part: SteppedPart { Steps: var steps, Inner: var inner } } => Apply(steps, Expand(inner)),
            { Part: RecursivePart { IsSum: true, Recursives: [var sum] } } => [.. sum.Calls.SelectMany(term =>
                !IsOfBody(term.Target) ? [term]
                : (RecursiveCall[])[Under(term.Map, term.Colour, NamePart(term.Target))])],
            { Part: RecursivePart { IsFlat: true } } => [NamePart(part)],
            _ => throw new ArgumentException("a recursive within a body can't have calls of the body's recursive", nameof(bodies)),
        };

        ImmutableArray<RecursiveCall> Apply(ImmutableArray<FractalStep> steps, ImmutableArray<RecursiveCall> calls)
        {
            var levels = FractalSteps.LevelCount(steps) is <= MaxUnrolledLevels and { } count ? count
                : throw new ArgumentException($"a repetition of calls has at most {MaxUnrolledLevels} levels", nameof(bodies));
            var sets = Enumerable.Range(0, (int)levels).Select(level => FractalSteps.LevelAt(steps, level)).ToList();
            if (sets.Exists(static set => set.Maps.IsEmpty))
            {
                return [];
            }

            foreach (var set in Enumerable.Reverse(sets))
            {
                var target = Name(unnamed with { Calls = calls });
                calls = [.. set.Maps.Select((map, index) => Under(map, set.ColourOf(index), target))];
            }

            return calls;
        }

        // A set of sets, or a sum or choice in a set, is a recursive of its own.
        RecursiveCall Name(FractalRecursive recursive)
        {
            if (recursive is { Choice: null, Calls: [{ IsConstant: false, IsPlain: true } only] })
            {
                return only;
            }

            if (!unnamedCalls.TryGetValue(recursive, out var call))
            {
                recursives.Add(recursive);
                unnamedCalls[recursive] = call = new(AffineMap.Identity, recursives.Count - 1, LevelsLess: 0);
            }

            return call;
        }

        static RecursiveCall Under(in AffineMap map, MapColour colour, RecursiveCall target) =>
            target with { Map = map, Colour = colour.Over(target.Colour) };
    }

    /// <summary>Tells whether a part has calls that belong to no recursive yet.</summary>
    public bool HasCalls(int part) => _entries[part].HasCalls;

    /// <summary>The steps that a part applies to a call, none for a call itself; null for other parts.</summary>
    public ImmutableArray<FractalStep>? StepsOnCall(int part) => IsCall(part) ? []
        : _entries[part].Part is SteppedPart stepped && IsCall(stepped.Inner) ? stepped.Steps : null;

    /// <summary>Tells whether a part is a call itself.</summary>
    public bool IsCall(int part) => _entries[part].Call is not null;

    /// <summary>Tells whether a part depends on the level of the body that it stands in.</summary>
    private bool IsOfBody(int part) => HasCalls(part) || _entries[part].CountsLevels;

    private bool IsSum(int part) => _entries[part].Part is RecursivePart { IsSum: true };

    /// <summary>Tells whether a part is repeated without end, or made of such parts.</summary>
    public bool IsInfinite(int part) => _entries[part].IsInfinite;

    /// <summary>Describes a fractal by the parts that it is made of.</summary>
    /// <param name="whole">Index of the part that steps are applied to.</param>
    /// <param name="steps">Steps of the whole.</param>
    /// <param name="composition">How chains of the steps are composed.</param>
    /// <param name="meshes">Receives the numbers of the base meshes in the order of the description: smaller ones first.</param>
    /// <exception cref="ArgumentException">The part has calls.</exception>
    public FractalDescription Describe(
        int whole, ImmutableArray<FractalStep> steps, Composition composition, out ImmutableArray<int> meshes)
    {
        while (_entries[whole].Part is SteppedPart outermost)
        {
            (whole, steps) = (outermost.Inner, steps.AddRange(outermost.Steps));
        }

        ArgumentCheck.Require(!HasCalls(whole), "expected a part without calls", nameof(whole));
        if (_entries[whole].Mesh is { } only)
        {
            meshes = [only];
            return new(steps, composition);
        }

        List<int> parts = ListWithReferences(whole);
        int[] order =
        [
            .. parts.Where(i => _entries[i].Part is null).OrderBy(i => _entries[i].Mesh),
            .. parts.Where(i => _entries[i].Part is not null),
        ];
        var indices = order.Index().ToDictionary(static pair => pair.Item, static pair => pair.Index);
        meshes = [.. order.Select(i => _entries[i].Mesh).OfType<int>()];
        return new(steps, composition)
        {
            MeshCount = meshes.Length,
            Parts = [.. order.Skip(meshes.Length).Select(i => _entries[i].Part!.WithReferences(reference => indices[reference]))],
        };
    }

    /// <summary>
    /// Lists a part behind all that it is made of, in an order that its references alone decide: so what is made in another order is equal.
    /// </summary>
    private List<int> ListWithReferences(int whole)
    {
        var listed = new List<int>();
        var open = new Stack<int>([whole]);
        var states = new Dictionary<int, bool>();
        while (open.TryPeek(out var part))
        {
            if (states.TryAdd(part, false))
            {
                foreach (var reference in (_entries[part].Part?.References ?? []).Reverse())
                {
                    if (!states.ContainsKey(reference))
                    {
                        open.Push(reference);
                    }
                }

                continue;
            }

            open.Pop();
            if (!states[part])
            {
                states[part] = true;
                listed.Add(part);
            }
        }

        return listed;
    }

    /// <summary>
    /// The calls of a part that stands as a constant: a set on a part is as many calls of that. Without any, calls below it are still seen.
    /// </summary>
    private ImmutableArray<RecursiveCall> CallsOf(int part, bool isWhole = false) => _entries[part] switch
    {
        _ when isWhole && keepsSums => [RecursiveCall.ToPart(part)],
        { Part: SteppedPart { Steps: [TransformationSet { Maps.IsEmpty: false } set, .. var rest], Inner: var inner } }
            when HasCalls(inner) || keepsSums => ApplyTo(set, AddSteps(inner, rest)),
        { Part: SteppedPart { Steps: [TransformationSet { Maps.Length: <= MaxInlined } set], Inner: var inner } } when !HasCalls(inner) =>
            ApplyTo(set, inner),
        { Part: RecursivePart { IsSum: true, Recursives: [var sum] } }
            when !keepsSums && (sum.Calls.Length <= MaxInlined || HasCalls(part)) => sum.Calls,
        _ => [RecursiveCall.ToPart(part)],
    };

    private static ImmutableArray<RecursiveCall> ApplyTo(TransformationSet set, int part) =>
        [.. set.Maps.Select((map, index) => RecursiveCall.ToPart(map, part) with { Colour = set.ColourOf(index) })];

    private int Add(Entry entry)
    {
        if (!_known.TryGetValue(entry, out var index))
        {
            var references = entry.Part?.References ?? [];
            index = _entries.Count;
            _entries.Add(entry with
            {
                HasCalls = entry.Call is not null || references.Any(HasCalls),
                IsInfinite = entry.Part?.IsInfinite == true || references.Any(IsInfinite),
                CountsLevels = entry.CountsLevels || entry.Part switch
                {
                    RecursivePart { IsFlat: true } => references.Any(reference => _entries[reference].CountsLevels),
                    SteppedPart { Inner: var inner } stepped =>
                        _entries[inner].CountsLevels && stepped.Steps.All(static step => step is TransformationSet),
                    _ => false,
                },
            });
            _known.Add(entry, index);
        }

        return index;
    }

    private sealed record Entry(FractalPart? Part, int? Mesh, int? Call)
    {
        public bool HasCalls { get; init; }

        public bool IsInfinite { get; init; }

        // A choice by level counts the levels of the body that it stands in.
        public bool CountsLevels { get; init; }
    }
}
