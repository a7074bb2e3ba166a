namespace FractalEngine.Core.Detail;

/// <summary>What it took to choose what is drawn, and what was left out.</summary>
public record struct DetailCost
{
    /// <summary>Sub-fractals looked at.</summary>
    public long Nodes { get; set; }

    /// <summary>Of these, beside the picture, with all below.</summary>
    public long Outside { get; set; }

    /// <summary>Of these, hidden behind nearer ones, with all below.</summary>
    public long Hidden { get; set; }

    /// <summary>Of these, drawn as one copy of the base mesh because of their size.</summary>
    public long StandIns { get; set; }

    /// <summary>Copies of the base mesh that would have covered no pixel that is not covered by nearer ones.</summary>
    public long Uncovering { get; set; }

    /// <summary>Sum of two costs.</summary>
    public static DetailCost operator +(DetailCost cost1, DetailCost cost2) => new()
    {
        Nodes = cost1.Nodes + cost2.Nodes,
        Outside = cost1.Outside + cost2.Outside,
        Hidden = cost1.Hidden + cost2.Hidden,
        StandIns = cost1.StandIns + cost2.StandIns,
        Uncovering = cost1.Uncovering + cost2.Uncovering,
    };
}
