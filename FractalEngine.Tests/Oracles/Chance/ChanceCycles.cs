namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Looks for cycles of calls that don't shrink.</summary>
internal static class ChanceCycles
{
    // Cycles that shrink less are left out: rounding decides of them, or they are long.
    private const double GreatestStretch = 0.97;

    /// <summary>Refuses a group with calls that lead back without being much smaller.</summary>
    public static void RequireShrinking(ChanceGroup group)
    {
        var count = group.Bodies.Length;
        var stretches = new double[count, count];
        for (var i = 0; i < count; i++)
        {
            Visit(group.Bodies[i], 1, i);
        }

        // The largest of all ways from one to another.
        for (var k = 0; k < count; k++)
        {
            for (var i = 0; i < count; i++)
            {
                for (var j = 0; j < count; j++)
                {
                    stretches[i, j] = Math.Max(stretches[i, j], stretches[i, k] * stretches[k, j]);
                }
            }
        }

        for (var i = 0; i < count; i++)
        {
            ChanceResolver.Require(stretches[i, i] < GreatestStretch, "calls that don't shrink");
        }

        void Visit(ChanceNode node, double stretch, int from)
        {
            switch (node)
            {
                case ChanceNode.Call(var to):
                    stretches[from, to] = Math.Max(stretches[from, to], stretch);
                    break;
                case ChanceNode.Whole(var one):
                    Visit(one, stretch, from);
                    break;
                case ChanceNode.Mapped(var maps, var inner):
                    Visit(inner, stretch * maps.Max(static map => map.Stretch), from);
                    break;
                case ChanceNode.Sum(var terms):
                    foreach (var term in terms)
                    {
                        Visit(term, stretch, from);
                    }

                    break;
                case ChanceNode.Choice choice:
                    foreach (var (_, alternative) in choice.Alternatives)
                    {
                        Visit(alternative, stretch, from);
                    }

                    break;
            }
        }
    }
}
