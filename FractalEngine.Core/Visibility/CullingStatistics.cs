
namespace FractalEngine.Core.Visibility;

/// <summary>What it took to choose what is drawn, and what was left out.</summary>
public record struct CullingStatistics
{
    /// <summary>Sub-fractals looked at.</summary>
    public long VisitedNodes { get; set; }

    /// <summary>Of these, beside the picture, with all below.</summary>
    public long OutsideFrustum { get; set; }

    /// <summary>Of these, hidden behind nearer ones, with all below.</summary>
    public long Occluded { get; set; }

    /// <summary>Of these, drawn as one copy of the base mesh because of their size.</summary>
    public long Proxies { get; set; }

    /// <summary>Copies of the base mesh that would have covered no pixel that is not covered by nearer ones.</summary>
    public long ZeroCoverage { get; set; }

    /// <summary>Sum of two costs.</summary>
    public static CullingStatistics operator +(CullingStatistics statistics1, CullingStatistics statistics2) => new()
    {
        VisitedNodes = statistics1.VisitedNodes + statistics2.VisitedNodes,
        OutsideFrustum = statistics1.OutsideFrustum + statistics2.OutsideFrustum,
        Occluded = statistics1.Occluded + statistics2.Occluded,
        Proxies = statistics1.Proxies + statistics2.Proxies,
        ZeroCoverage = statistics1.ZeroCoverage + statistics2.ZeroCoverage,
    };
}
