using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Mtl;

/// <summary>A texture that a material may have.</summary>
/// <param name="Keywords">The statements that declare it in a material file. The first is that of written files.</param>
/// <param name="Consequence">What happens without its image, for a message; null where no image shows it.</param>
/// <param name="Of">Returns the texture of a material.</param>
/// <param name="With">Returns a material with another texture, or with null because its image can't be used.</param>
internal sealed record TextureSlot(
    string[] Keywords, string? Consequence, Func<Material, MaterialTexture?> Of, Func<Material, MaterialTexture?, Material> With)
{
    /// <summary>All textures, in the order of a written file.</summary>
    public static ImmutableArray<TextureSlot> All { get; } =
    [
        new(["map_Kd"], "drawn grey", static material => material.Texture,
            static (material, texture) => texture is null ? material.WithoutTexture() : material with { Texture = texture }),
        new(["map_d"], "drawn opaque", static material => material.OpacityTexture,
            static (material, texture) => material with { OpacityTexture = texture }),
        new(["map_Ke"], null, static material => material.EmissionTexture,
            static (material, texture) => material with { EmissionTexture = texture }),
        new(["map_Bump", "map_bump", "bump"], "shown without it", static material => material.BumpTexture,
            static (material, texture) => material with { BumpTexture = texture }),
        new(["norm"], "shown without it", static material => material.NormalTexture,
            static (material, texture) => material with { NormalTexture = texture }),
    ];

    /// <summary>The textures by the statements that declare them.</summary>
    public static IReadOnlyDictionary<string, TextureSlot> ByKeyword { get; } =
        All.SelectMany(static slot => slot.Keywords.Select(keyword => (keyword, slot))).ToDictionary();
}
