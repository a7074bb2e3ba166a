namespace FractalEngine.Mutants;

/// <summary>A part of the product that mutants are drawn from.</summary>
/// <param name="Name">What the report calls it.</param>
/// <param name="Contains">Tells by a file's path whether it belongs to it.</param>
internal sealed record Group(string Name, Func<string, bool> Contains)
{
    /// <summary>The five groups of the ordinary draw.</summary>
    public static IReadOnlyList<Group> All { get; } =
    [
        new("Collision, Fractals", path => !IsOfRays(path) && IsInAny(
            path, "Bvh", "Colliders", "Fractals", "Geometry/Hulls", "Geometry/Triangles", "Queries", "SceneQueries")),
        new("Rays", IsOfRays),
        new("Physics", path => IsIn(path, "FractalEngine.Core/Physics")),
        new("Parsing", path => IsIn(path, "FractalEngine.Parsing")),
        new("Commands", path => IsIn(path, "FractalEngine.App") && !IsIn(path, "FractalEngine.App/Window")),
    ];

    /// <summary>Makes the group of one folder.</summary>
    public static Group Of(string folder) => new(folder, path => IsIn(path, folder));

    private static bool IsOfRays(string path) => IsInAny(path, "DeepZoom", "Fractals/Levels/Rays", "Geometry/Rays", "Rays");

    private static bool IsInAny(string path, params string[] rooms) => rooms.Any(room => IsIn(path, $"FractalEngine.Core/{room}"));

    private static bool IsIn(string path, string folder) => path.StartsWith(folder + "/", StringComparison.Ordinal) || path == folder;
}

/// <summary>Draws mutants without replacement: sites in an order that the seed chooses, and of each site one change.</summary>
/// <remarks>
/// The order is that of a hash of seed and site. So every machine draws the same, and a change of the product replaces only the mutants
/// of the places that changed.
/// </remarks>
internal sealed class Draw
{
    private readonly Dictionary<Mutation, Queue<Change>> _others = [];
    private readonly Dictionary<string, Queue<Site>> _left = [];
    private readonly List<Mutation> _drawn = [];
    private readonly string _seed;

    /// <summary>Draws from the sites of each group.</summary>
    /// <param name="sites">All sites of the product.</param>
    /// <param name="groups">The groups, which take equal shares.</param>
    /// <param name="sample">Number of mutants of all groups together.</param>
    /// <param name="seed">Seed, part of what is hashed.</param>
    public Draw(IReadOnlyList<Site> sites, IReadOnlyList<Group> groups, int sample, string seed)
    {
        _seed = seed;
        for (int i = 0; i < groups.Count; i++)
        {
            var group = groups[i];
            _left[group.Name] = new(sites.Where(site => group.Contains(site.Path)).OrderBy(site => Hashing.Rank($"{seed}|{site.Key}"))
                .ThenBy(site => site.Key, StringComparer.Ordinal));
            int share = sample * (i + 1) / groups.Count - sample * i / groups.Count;
            for (int j = 0; j < share; j++)
            {
                DrawNext(group.Name);
            }
        }
    }

    /// <summary>Takes some mutants as they are.</summary>
    public Draw(IEnumerable<Mutation> mutations)
    {
        _seed = "";
        foreach (var mutation in mutations)
        {
            mutation.Group = "chosen";
            _drawn.Add(mutation);
        }

        _left["chosen"] = new();
    }

    /// <summary>Takes faults besides. One that doesn't compile isn't replaced.</summary>
    public void Add(IEnumerable<Mutation> faults)
    {
        _drawn.AddRange(faults);
        _left[HandFaults.Group] = new();
    }

    /// <summary>The mutants drawn so far.</summary>
    public IReadOnlyList<Mutation> Drawn => _drawn;

    /// <summary>Replaces a mutant that doesn't compile by another of its site, or of the next site of its group.</summary>
    public void Replace(Mutation mutation)
    {
        _drawn.Remove(mutation);
        if (!_others.Remove(mutation, out var others) || !Add(mutation.Site, others, mutation.Group))
        {
            DrawNext(mutation.Group);
        }
    }

    private void DrawNext(string group)
    {
        if (_left[group].TryDequeue(out var site))
        {
            string key = site.Key;
            Add(site, new(site.Changes.OrderBy(change => Hashing.Rank($"{_seed}|{key}|{change.Operator}"))), group);
        }
    }

    private bool Add(Site site, Queue<Change> changes, string group)
    {
        if (!changes.TryDequeue(out var change))
        {
            return false;
        }

        var mutation = new Mutation(site, change) { Group = group };
        _others[mutation] = changes;
        _drawn.Add(mutation);
        return true;
    }
}
