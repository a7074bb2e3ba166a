using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

/// <content>Parses the player and the options that follow it.</content>
public sealed partial class SceneParser
{
    private bool ParsePlayer(Cursor cursor, out Cursor rest)
    {
        if (!ParseVector(cursor, out var position, out rest) || !ParseOptionalSeparator(rest, out var radiusStart)
            || !ParseNumber(radiusStart, out var radius, out rest) || !ParseNextNumber(rest, out var height, out rest))
        {
            return false;
        }

        Require(radius > 0 && height >= 2 * radius, radiusStart,
            "the player's radius must be positive, and the height at least twice as much");
        Require(height <= Player.MaxHeightPerRadius * radius, radiusStart,
            $"the player's height must be at most {Player.MaxHeightPerRadius} times the radius");
        var player = ParseOptions(rest, new Player(position, radius, height), ParsePlayerOption, out rest);
        return UpdateScene(_scene with { Player = player });
    }

    private bool ParsePlayerOption(Cursor cursor, ref Player player, out Cursor rest)
    {
        if (ParseKeyword(cursor, "speed", out rest))
        {
            return ParseNonNegative(rest, "the player's speed", out var speed, out rest)
                && Set(ref player, player with { WalkingSpeedOverride = speed });
        }

        if (ParseKeyword(cursor, "jump", out rest))
        {
            return ParseNonNegative(rest, "the speed of a jump", out var jump, out rest)
                && Set(ref player, player with { JumpSpeedOverride = jump });
        }

        if (ParseKeyword(cursor, "slope", out rest))
        {
            const string fault = "the player's slope must lie between 0 and 89 degrees";
            return ParseNumber(rest, static angle => angle is >= 0 and <= Player.MaxSlopeAngleLimit, fault, out var slope, out rest)
                && Set(ref player, player with { MaxSlopeAngle = slope });
        }

        var height = player.Height;
        const string stepFault = "the player's step must not be negative, and less than the height";
        return ParseKeyword(cursor, "step", out rest)
            && ParseNumber(rest, number => number >= 0 && number < height, stepFault, out var step, out rest)
            && Set(ref player, player with { StepHeightOverride = step });
    }
}
