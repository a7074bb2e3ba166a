using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Scenes;

/// <content>The player and what may stand behind it.</content>
public sealed partial class SceneParser
{
    private bool ParsePlayer(Cursor cursor, out Cursor rest)
    {
        if (!ParseVector(cursor, out var position, out rest) || !ParseOptionalSeparator(rest, out var radiusStart)
            || !ParseNumber(radiusStart, out var radius, out rest) || !ParseSeparator(rest, out rest)
            || !ParseNumber(rest, out var height, out rest))
        {
            return false;
        }

        Require(radius > 0 && height >= 2 * radius, radiusStart,
            "the player's radius must be positive, and the height at least twice as much");
        var player = new Player(position, radius, height);
        while (ParsePlayerOption(rest, ref player, out rest))
        {
        }

        return UpdateScene(_scene with { Player = player });
    }

    /// <summary>One of the trailing parts of the player; false, and the cursor unmoved, when there is none.</summary>
    private bool ParsePlayerOption(Cursor cursor, ref Player player, out Cursor rest)
    {
        rest = cursor;
        if (!ParseBlankOrEndOfLine(cursor, out var start))
        {
            return false;
        }

        var (success, next) = (false, start);
        if (ParseKeyword(start, "speed", out next))
        {
            success = ParseNonNegative(next, "the player's speed", out var speed, out next);
            player = player with { WalkingSpeedOverride = speed };
        }
        else if (ParseKeyword(start, "jump", out next))
        {
            success = ParseNonNegative(next, "the speed of a jump", out var jump, out next);
            player = player with { JumpSpeedOverride = jump };
        }
        else if (ParseKeyword(start, "slope", out var valueStart))
        {
            success = ParseNumber(valueStart, out var slope, out next);
            Require(!success || slope is >= 0 and <= Player.MaxSlopeAngleLimit, valueStart,
                "the player's slope must lie between 0 and 89 degrees");
            player = player with { MaxSlopeAngle = slope };
        }
        else if (ParseKeyword(start, "step", out valueStart))
        {
            success = ParseNumber(valueStart, out var step, out next);
            Require(!success || (step >= 0 && step < player.Height), valueStart,
                "the player's step must not be negative, and less than the height");
            player = player with { StepHeightOverride = step };
        }

        rest = success ? next : next.Offset > start.Offset ? throw SyntaxError() : cursor;
        return success;
    }
}
