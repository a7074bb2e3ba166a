namespace FractalEngine.Core.Visibility;

/// <summary>Numbers of the sub-fractals that culling tested in one frame, and of those that it skipped or simplified, by reason.</summary>
public record struct CullingStatistics
{
    /// <summary>Number of sub-fractals that were tested.</summary>
    public long VisitedNodes { get; set; }

    /// <summary>Number of tested sub-fractals outside the view frustum, whose children were skipped.</summary>
    public long OutsideFrustum { get; set; }

    /// <summary>Number of tested sub-fractals hidden behind closer ones, whose children were skipped.</summary>
    public long Occluded { get; set; }

    /// <summary>Number of tested sub-fractals drawn as one proxy instance because of their size.</summary>
    public long Proxies { get; set; }

    /// <summary>Number of tested sub-fractals that cover no sample, or none that closer ones leave free.</summary>
    public long ZeroCoverage { get; set; }

    /// <summary>Number of tested sub-fractals beyond the section plane, whose children were skipped.</summary>
    public long CutAway { get; set; }

    /// <summary>Adds the counts of two parts of a frame.</summary>
    public static CullingStatistics operator +(CullingStatistics statistics1, CullingStatistics statistics2) => new()
    {
        VisitedNodes = statistics1.VisitedNodes + statistics2.VisitedNodes,
        OutsideFrustum = statistics1.OutsideFrustum + statistics2.OutsideFrustum,
        Occluded = statistics1.Occluded + statistics2.Occluded,
        Proxies = statistics1.Proxies + statistics2.Proxies,
        ZeroCoverage = statistics1.ZeroCoverage + statistics2.ZeroCoverage,
        CutAway = statistics1.CutAway + statistics2.CutAway,
    };
}
