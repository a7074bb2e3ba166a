namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>All parts that some calls of recursives explain, by rising level.</summary>
internal sealed class CallExpansion
{
    private CallExpansion(CallScene scene) => IsExplained = new bool[scene.Group.Set.Count];

    /// <summary>The parts, the root first.</summary>
    public List<CallPart> Parts { get; } = [];

    /// <summary>Which elements of the set are among the parts.</summary>
    public bool[] IsExplained { get; }

    /// <summary>The largest number of calls.</summary>
    public int Depth => Parts[^1].Level;

    /// <summary>
    /// Follows all calls as far as there are elements; null where a part lacks one of its calls though others have more levels.
    /// </summary>
    /// <param name="scene">Where parts are looked for.</param>
    /// <param name="rules">The calls.</param>
    /// <param name="isWhole">Whether small parts are followed as well.</param>
    public static CallExpansion? Create(CallScene scene, IReadOnlyList<CallRule> rules, bool isWhole = false)
    {
        var expansion = new CallExpansion(scene);
        foreach (var root in scene.Roots)
        {
            // With noise, maps of thin parts take not even the root where they were found.
            if (scene.Image(root) is var image && image < 0)
            {
                return null;
            }

            expansion.Add(new(image, root, -1, 0, 0));
        }

        var lastLevel = int.MaxValue;
        for (var next = 0; next < expansion.Parts.Count; next++)
        {
            var part = expansion.Parts[next];
            if (!isWhole && !scene.IsLarge(part.Element))
            {
                continue;
            }

            for (var rule = 0; rule < rules.Count; rule++)
            {
                if (rules[rule].Caller != part.Recursive)
                {
                    continue;
                }

                var frame = part.Frame * rules[rule].Map;
                var image = scene.Image(frame);
                if (image < 0)
                {
                    lastLevel = part.Level;
                }
                else if (!expansion.IsExplained[image])
                {
                    expansion.Add(new(image, frame, rule, rules[rule].Called, part.Level + 1));
                }

                if (expansion.Depth > lastLevel)
                {
                    return null;
                }
            }
        }

        return expansion;
    }

    private void Add(CallPart part)
    {
        Parts.Add(part);
        IsExplained[part.Element] = true;
    }
}
