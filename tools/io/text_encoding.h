/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <istream>
#include <memory>

namespace tool {

/** \brief The same text in UTF-8, of a file in UTF-16, as spreadsheets save it, with or
 * without a byte order mark.
 * \param[in] stream at its beginning, where it is left
 * \return null where the file is not in UTF-16
 * \throws std::runtime_error where it is not sound, or in UTF-32
 */
std::unique_ptr<std::istream>
decodedUTF16(std::istream& stream);

} // namespace tool
